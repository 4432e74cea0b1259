#pragma once

#include <imgui.h>

#include <string>

#include "gui/render/view.h"
#include "gui/view/tools/space_mover.h"
#include "gui/widgets/theme.h"

namespace winslow::gui {

/// The handle of what is selected in a volume mesh. What points away from the viewer is faint; in a
/// drag all is, but for what is held.
void draw_space_gizmo(ImDrawList& list, const View& view, const Theme& theme,
                      const SpaceGizmo& gizmo, const SpaceMover& mover);

/// What a handle does, for a hint beside the mouse; "" for none.
std::string space_handle_hint(const SpaceHandle& handle, const GizmoFrame& frame);
/// How far a drag is, or what is typed in its place.
std::string space_motion_text(const SpaceMover& mover, const View& view);

}  // namespace winslow::gui
