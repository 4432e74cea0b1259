#pragma once

#include "gui/menu/user_command.h"

namespace winslow::gui {

/// A command, or a submenu of commands, as an entry of the open menu. Scripts find it as
/// "menu/ID".
void draw_menu_entry(const UserCommand& command, const PanelContext& context);

}  // namespace winslow::gui
