#pragma once

#include <imgui.h>

#include "gui/render/view.h"
#include "gui/view/tools/mover.h"
#include "gui/widgets/theme.h"

namespace winslow::gui {

/// The handle of what is selected. What points away from the viewer is faint; in a drag all is, but
/// for what is held.
void draw_gizmo(ImDrawList& list, const View& view, const Theme& theme, const Gizmo& gizmo,
                const Mover& mover);

/// What a handle does, for a hint beside the mouse; "" for none.
std::string handle_hint(const Handle& handle, const GizmoPlace& place);
/// How far a drag is, or what is typed in its place.
std::string motion_text(const Mover& mover, const View& view);

}  // namespace winslow::gui
