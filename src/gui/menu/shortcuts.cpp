#include "gui/menu/shortcuts.h"

#include <algorithm>

#include "gui/menu/user_command.h"

namespace winslow::gui {

void handle_shortcuts(const PanelContext& context, bool dragging) {
  for (const UserCommand& command : user_commands()) {
    if (dragging && command.group != CommandGroup::view) continue;
    if (!std::any_of(command.keys.begin(), command.keys.end(), pressed)) continue;
    if (why_blocked(command, context).empty()) command.run(context);
  }
}

}  // namespace winslow::gui
