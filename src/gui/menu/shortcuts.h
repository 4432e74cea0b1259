#pragma once

#include "gui/menu/panel_context.h"

namespace winslow::gui {

/// Runs the commands whose keys were pressed in this frame (gui/menu/user_command.h). Call it
/// within a frame, not while a dialog is open or a field is being typed in. dragging: what happens
/// then is the mouse's business, and only the view's keys count.
void handle_shortcuts(const PanelContext& context, bool dragging);

}  // namespace winslow::gui
