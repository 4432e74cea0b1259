#pragma once

#include <imgui.h>

#include "core/inspect/node_roles.h"
#include "gui/view/mesh/volume_view.h"
#include "gui/view/overlays/view_overlay.h"

namespace winslow::gui {

/// Draws the roles of nodes in smoothing as coloured dots, with a key. Plane mesh: all nodes in
/// view, as far as there is room. Volume mesh: the visible nodes of the boundary. Nodes whose role
/// the options override have a ring, held ones are squares. Edges at which sliding markers turn are
/// lines. While the feature angle is edited, the roles are shown whatever the view's options are.
class RoleOverlay {
 public:
  /// picture: of a mesh in space. room: of the viewport, for the key.
  void draw(ImDrawList& list, const ViewOverlay& overlay, const VolumeView& picture,
            const ScreenBox& room);

 private:
  struct Dot {
    ScreenPoint at;
    NodeRole role;
    bool overridden;
  };
  /// What the dots depend on.
  struct Key {
    ViewKey view;
    std::uint64_t revision = 0;  // of the picture
    std::uint64_t shape = 0;
    std::shared_ptr<const NodeRoles> roles;
    bool operator==(const Key&) const = default;
  };
  void find_in_plane(const ViewOverlay& overlay, const NodeRoles& roles);
  void find_in_picture(const ViewOverlay& overlay, const VolumeScenes& scenes,
                       const NodeRoles& roles);

  Key key_;
  std::vector<Dot> dots_;
};

/// Colour of a role, for dots and key.
ImU32 color_of(NodeRole role);
/// Name of a role, such as "On a curve".
const char* name_of(NodeRole role);

}  // namespace winslow::gui
