#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/mesh/mesh.h"
#include "gui/base/screen.h"
#include "gui/settings/option_edits.h"
#include "gui/settings/view_state.h"

/// Where the user looks and what is drawn. Carried out by the workbench.
namespace winslow::gui::action {

/// Sets some of the view's options and leaves the others as they are.
struct EditView {
  OptionEdit<ViewOptions> edit;
};
struct FitView {};
struct FitSelection {};
/// Shows all holes of the mesh.
struct FitBodies {};
struct FitMarkers {
  std::vector<Index> markers;
};
/// Clicks measure from now on, or no longer.
struct ToggleRuler {};
struct LookAt {  ///< of a plane mesh
  Vec2 point;
  double radius = 0;  ///< shown around the point, in units of the mesh
};
/// The next drag of the mouse draws the box to zoom to; again: it does not.
struct BoxZoom {};
struct ZoomTo {
  Bounds box;  ///< fills the viewport
};
/// The same of a volume mesh: a point in the middle of the view.
struct LookAtPlace {
  Vec3 point;
  double radius = 0;
};
/// Of a volume mesh: what lies in a box of the screen; depth: of a point that fills it.
struct ZoomToScreen {
  ScreenBox box;
  Vec3 depth;
};
/// Looks at a volume mesh from a direction with a name, as named_view() knows it.
struct LookFrom {
  std::string name;
};
/// Looks at a volume mesh, and cuts it, as is said.
struct ShowLook {
  SpaceLook look;
};
/// The same through what is in the middle of the view, across the axis that points to the viewer
/// most.
struct AddCutAcrossView {};
/// Gives a cut a handle in the picture; none: none has one.
struct HoldCut {
  std::optional<std::size_t> cut;
};
/// Cuts a volume mesh by one more plane; what the normal points to is taken away.
struct AddCut {
  Vec3 point, normal;
};
struct BackView {};
struct ForwardView {};
/// Highlights a node or an element and centres it; none: nothing is highlighted any more.
struct GoTo {
  std::optional<MeshItem> item;
  bool centre = true;  ///< false: the view stays where it is
};
/// Selects a node, shows it in the inspector and brings it into sight.
struct InspectNode {
  std::optional<Index> node;
};
/// Pins the magnifier to the place under the mouse; pinned, it is put away.
struct PinMagnifier {};
/// Puts the keyboard into the field "Go to".
struct AskGoTo {};
/// Shows what nodes do while the mesh is smoothed, whatever the view's options are; or no longer.
struct PreviewRoles {
  bool on = false;
};
/// Steps the scale of the interface up (1) or down (-1), or back to the screen's own (0).
struct StepScale {
  int by = 0;
};

}  // namespace winslow::gui::action

namespace winslow::gui {

using ViewAction =
    std::variant<action::EditView, action::FitView, action::FitSelection, action::FitBodies,
                 action::FitMarkers, action::ToggleRuler, action::LookAt, action::BoxZoom,
                 action::ZoomTo, action::BackView, action::ForwardView, action::GoTo,
                 action::InspectNode, action::PinMagnifier, action::AskGoTo, action::PreviewRoles,
                 action::StepScale, action::LookAtPlace, action::ZoomToScreen, action::LookFrom,
                 action::AddCut, action::HoldCut, action::AddCutAcrossView, action::ShowLook>;

}  // namespace winslow::gui
