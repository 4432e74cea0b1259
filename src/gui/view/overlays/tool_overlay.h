#pragma once

#include <imgui.h>

#include "gui/document/session/session.h"
#include "gui/render/view.h"
#include "gui/view/overlays/view_overlay.h"
#include "gui/view/tools/motion_gesture.h"
#include "gui/view/tools/mover.h"
#include "gui/view/tools/ruler.h"
#include "gui/widgets/theme.h"

/// What the tools of the mouse show: what is said beside it, the handle of the selection, the
/// ruler.
namespace winslow::gui {

struct MouseLabel {
  std::string text;
  ImU32 background;
};

/// Below one another; on the mouse's other side where the view ends, since panels would cover them.
void draw_beside_mouse(ImDrawList& list, const View& view, const Theme& theme,
                       const std::vector<MouseLabel>& labels);

/// How far a drag is, and whether the mesh can follow, and what it is blocked by.
std::vector<MouseLabel> drag_labels(std::string motion, const Session& session);

/// What is typed into a field, with a bar where the next character goes.
std::string typed_field(const TypedMotion& typed, std::size_t field);

/// The handle of what is selected. What points away from the viewer is faint; in a drag all is, but
/// for what is held.
void draw_gizmo(ImDrawList& list, const View& view, const Theme& theme, const Gizmo& gizmo,
                const Mover& mover);

/// What a handle does, for a hint beside the mouse; "" for none.
std::string handle_hint(const Handle& handle, const GizmoPlace& place);
/// How far a drag is, or what is typed in its place.
std::string motion_text(const Mover& mover, const View& view);

/// Points of the ruler, the lines between them and what they measure; over all that is drawn.
void draw_ruler(ImDrawList& list, const ViewOverlay& overlay, const Ruler& ruler);

/// As it is shown: "Length 0.5412", "x +0.5   y -0.2", "-21.80 degrees against x", "Angle 90.00
/// degrees".
std::vector<std::string> measurement_lines(const Measurement& m);

}  // namespace winslow::gui
