#pragma once

#include <imgui.h>

#include "gui/document/session/session.h"
#include "gui/render/view.h"
#include "gui/view/overlays/view_overlay.h"
#include "gui/view/tools/motion_gesture.h"
#include "gui/view/tools/mover.h"
#include "gui/view/tools/ruler.h"
#include "gui/widgets/theme.h"

/// What the mouse tools show: labels beside the mouse, the handle of the selection, the ruler.
namespace winslow::gui {

struct MouseLabel {
  std::string text;
  ImU32 background;
};

/// Draws labels below one another beside the mouse; at the end of the view on its other side, since
/// panels would cover them.
void draw_beside_mouse(ImDrawList& list, const View& view, const Theme& theme,
                       const std::vector<MouseLabel>& labels);

/// Labels of a drag: its distance, whether the mesh can follow, and what blocks it.
std::vector<MouseLabel> drag_labels(std::string motion, const Session& session);

/// Text typed into a field, with a bar where the next character goes.
std::string typed_field(const TypedMotion& typed, std::size_t field);

/// Draws the handle of the selection. Parts that point away from the viewer are faint; during a
/// drag all parts are, except the held one.
void draw_gizmo(ImDrawList& list, const View& view, const Theme& theme, const Gizmo& gizmo,
                const Mover& mover);

/// What a handle does, for a hint beside the mouse; "" for none.
std::string handle_hint(const Handle& handle, const GizmoPlace& place);
/// Text for the distance of a drag, or for the numbers typed in its place.
std::string motion_text(const Mover& mover, const View& view);

/// Draws the ruler's points, the lines between them and their measurements, above everything else.
void draw_ruler(ImDrawList& list, const ViewOverlay& overlay, const Ruler& ruler);

/// Lines of text for a measurement: "Length 0.5412", "x +0.5   y -0.2", "-21.80 degrees against x",
/// "Angle 90.00 degrees".
std::vector<std::string> measurement_lines(const Measurement& m);

}  // namespace winslow::gui
