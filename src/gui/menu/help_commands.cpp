#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include "gui/demos/demo_player.h"
#include "gui/files/assets.h"
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

namespace {

std::string without_demo(const PanelContext& context) {
  return context.demo.demo() ? "" : "No demo is being played.";
}

std::string cannot_step(const PanelContext& context) {
  if (!context.demo.demo()) return without_demo(context);
  return context.demo.ready(context.session) ? "" : "The step is not done yet.";
}

std::vector<UserCommand> all_demos(const PanelContext&) {
  std::vector<UserCommand> items;
  for (const Demo& demo : demos())
    items.push_back(
        {.id = "demo/" + demo.id,
         .label = "Case " + demo.id + ": " + demo.title,
         .group = CommandGroup::help,
         .tooltip = "Play this case of the paper step by step.",
         .run = [id = demo.id](const PanelContext& c) { c.emit(action::StartDemo{id}); }});
  return items;
}

}  // namespace

std::vector<UserCommand> demo_commands() {
  constexpr auto group = CommandGroup::help;
  return {
      {.id = "demos",
       .label = "Guided demos",
       .group = group,
       .tooltip = "The cases of the paper, step by step.",
       .words = "tutorial example tour",
       .blocked = [](const PanelContext&) -> std::string {
         return assets_folder().empty() ? "The bundled meshes are not installed." : "";
       },
       .starts_section = true,
       .items = all_demos},
      {.id = "demo_next",
       .label = "Next step of the demo",
       .group = group,
       .keys = {key(GLFW_KEY_PAGE_DOWN)},
       .tooltip = "On to the next step.",
       .blocked = cannot_step,
       .run = [](const PanelContext& c) { c.emit(action::StepDemo{1}); }},
      {.id = "demo_back",
       .label = "Step back in the demo",
       .group = group,
       .keys = {key(GLFW_KEY_PAGE_UP)},
       .tooltip = "Back to where the step before had ended.",
       .blocked = cannot_step,
       .run = [](const PanelContext& c) { c.emit(action::StepDemo{-1}); }},
      {.id = "demo_end",
       .label = "End the demo",
       .group = group,
       .keys = {key(GLFW_KEY_ESCAPE)},
       .tooltip = "Leave the demo; the mesh stays open.",
       .blocked = [](const PanelContext& c) -> std::string {
         if (!c.demo.demo()) return without_demo(c);
         return c.session.job().active() ? "Esc cancels the solver now." : "";
       },
       .run = [](const PanelContext& c) { c.emit(action::EndDemo{}); }},
  };
}

}  // namespace winslow::gui
