#pragma once

#include <imgui.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "gui/base/screen.h"
#include "gui/view/mesh/volume_view.h"
#include "gui/view/overlays/space_overlay.h"
#include "gui/view/overlays/view_overlay.h"
#include "gui/widgets/theme.h"

namespace winslow::gui {

// More would be no help to anyone, and slow.
inline constexpr std::size_t most_id_labels = 600;

/// The number of a node or of an element, where it is on the screen.
struct IdLabel {
  ScreenPoint at;  ///< middle of the text
  std::string text;
  bool node = false;
};

ImVec2 id_label_size(const Theme& theme, const std::string& text);
/// Nodes on cards, elements bare but for what sets them off: the two are told apart.
void draw_id_label(ImDrawList& list, const Theme& theme, const IdLabel& label);
/// What stands in place of numbers that have no room. at: its upper left corner.
void draw_no_id_labels(ImDrawList& list, const Theme& theme, const ImVec2& at);

/// Ids of nodes and elements on the mesh: of those that are large enough on screen to hold their
/// number, and none of the others.
class IdLabels {
 public:
  void draw(ImDrawList& list, const ViewOverlay& overlay);

 private:
  /// What the labels depend on.
  struct Key {
    std::uint64_t generation = 0, shape = 0;
    Bounds seen{{0, 0}, {0, 0}};
    ScreenBox viewport;
    float scale = 0;
    bool nodes = false, elements = false;
    bool operator==(const Key&) const = default;
  };
  static Key key_of(const ViewOverlay& overlay);
  void find(const ViewOverlay& overlay);
  void find_nodes(const ViewOverlay& overlay);
  void find_elements(const ViewOverlay& overlay);

  Key key_;
  std::vector<IdLabel> labels_;
};

/// Ids of nodes and elements of a volume mesh, of those that are seen: on the surfaces, cuts and
/// single elements of the picture, where there is room for the number and nothing hides it.
class SpaceIdLabels {
 public:
  void draw(ImDrawList& list, const SpaceOverlay& overlay, const VolumeView& picture);

 private:
  struct Label {
    IdLabel drawn;
    double depth = 0;
    bool hidden = false;
  };
  /// What the labels depend on.
  struct Key {
    SpaceCamera camera;
    std::uint64_t revision = 0;  // of the picture
    float scale = 0;
    bool nodes = false, elements = false;
    bool operator==(const Key&) const = default;
  };
  void find(const SpaceOverlay& overlay, const VolumeScenes& scenes);
  void find_in(const SpaceOverlay& overlay, const SpaceScene& part, const VolumeScenes& scenes);
  struct Item {
    Index id;
    bool node;
  };
  /// room: pixels.
  void add_label(const SpaceOverlay& overlay, const Vec3& point, const Item& item, double room);
  void hide_what_lies_behind(const SpaceOverlay& overlay, const VolumeScenes& scenes);

  Key key_;
  std::vector<Label> labels_;
};

}  // namespace winslow::gui
