#pragma once

#include <imgui.h>

#include "gui/view/mesh/volume_view.h"
#include "gui/view/overlays/view_overlay.h"

namespace winslow::gui {

/// The number of a node or of an element, where it is on the screen.
struct IdLabel {
  ScreenPoint at;  ///< middle of the text
  std::string text;
  bool node = false;
};

/// Draws ids of nodes and elements on the mesh, where the number has room. Plane mesh: those in
/// view that are large enough for their number. In space: the visible ones on surfaces, cuts and
/// single elements of the picture.
class IdLabels {
 public:
  /// picture: of a mesh in space. room: of the viewport, for a message where no number has room.
  void draw(ImDrawList& list, const ViewOverlay& overlay, const VolumeView& picture,
            const ScreenBox& room);

 private:
  struct Label {
    IdLabel drawn;
    double depth = 0;
    bool hidden = false;
  };
  /// What the labels depend on.
  struct Key {
    std::uint64_t generation = 0, shape = 0;
    std::uint64_t revision = 0;  // of the picture
    ViewKey view;
    float scale = 0;
    bool nodes = false, elements = false;
    bool operator==(const Key&) const = default;
  };
  void find(const ViewOverlay& overlay, const VolumeView& picture);
  void find_nodes(const ViewOverlay& overlay);
  void find_elements(const ViewOverlay& overlay);
  void find_in_picture(const ViewOverlay& overlay, const VolumeScenes& scenes);
  void find_in(const ViewOverlay& overlay, const SpaceScene& part, const VolumeScenes& scenes);
  struct Item {
    Index id;
    bool node;
  };
  /// room: pixels.
  void add_label(const ViewOverlay& overlay, const Vec3& point, const Item& item, double room);
  void hide_what_lies_behind(const ViewOverlay& overlay, const VolumeScenes& scenes);

  Key key_;
  std::vector<Label> labels_;
};

}  // namespace winslow::gui
