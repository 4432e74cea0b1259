#pragma once

#include "gui/menu/panel_context.h"
#include "gui/panels/forms/motion_steps_row.h"

namespace winslow::gui {

/// Rows for the region outside which nothing moves (SmoothOptions::keep_outside): none, a circle
/// about the selection (of a volume mesh a sphere), a box around it.
void draw_keep_outside(const PanelContext& context);

}  // namespace winslow::gui
