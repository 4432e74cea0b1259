#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include "gui/menu/user_command.h"

namespace winslow::gui {

std::vector<UserCommand> help_commands() {
  constexpr auto group = CommandGroup::help;
  return {
      {.id = "palette",
       .label = "Find a command...",
       .group = group,
       .keys = {control(key(GLFW_KEY_P))},
       .tooltip = "Type a few letters of what you want to do.",
       .run = [](const PanelContext& c) { c.emit(action::ShowPalette{}); }},
      {.id = "help",
       .label = "Keys and mouse",
       .group = group,
       .keys = {typed(U'?'), key(GLFW_KEY_F1)},
       .tooltip = "All keys, and what the mouse does.",
       .words = "shortcuts hotkeys help",
       .run = [](const PanelContext& c) { c.emit(action::ShowHelp{}); }},
      {.id = "welcome",
       .label = "Welcome",
       .group = group,
       .tooltip = "Recent files, the bundled meshes and the guided demos.",
       .blocked = [](const PanelContext& c) -> std::string {
         return c.session.document() ? "" : "It is shown already.";
       },
       .run = [](const PanelContext& c) { c.emit(action::ShowWelcome{}); },
       .starts_section = true},
      {.id = "about",
       .label = "About winslow",
       .group = group,
       .tooltip = "Versions, graphics and licence.",
       .run = [](const PanelContext& c) { c.emit(action::ShowAbout{}); }},
  };
}

}  // namespace winslow::gui
