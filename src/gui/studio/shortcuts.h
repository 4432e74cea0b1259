#pragma once

#include "gui/panels/panel.h"

namespace winslow::gui {

/// Emits the actions of the keys pressed in this frame. Call it within a frame, not while a dialog
/// is open or a field is being typed in. dragging: Esc belongs to the drag.
void handle_shortcuts(const PanelContext& context, bool dragging);

}  // namespace winslow::gui
