#pragma once

#include <imgui.h>

#include <cstdint>
#include <vector>

#include "gui/view/mesh/volume_view.h"
#include "gui/view/overlays/id_label_drawing.h"
#include "gui/view/overlays/space_overlay.h"

namespace winslow::gui {

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
