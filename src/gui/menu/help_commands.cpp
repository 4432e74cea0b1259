#include "gui/demos/demo_player.h"
#include "gui/files/assets.h"
#include "gui/menu/user_command.h"

namespace winslow::gui {

std::vector<UserCommand> help_commands() {
  return {
      entry("palette", "Find a command...", {control(key('P'))},
            "Type a few letters of what you want to do.", emits(action::ShowPalette{})),
      entry("help", "Keys and mouse", {typed(U'?'), key(GLFW_KEY_F1)},
            "All keys, and what the mouse does.", emits(action::ShowHelp{}),
            {.words = "shortcuts hotkeys help"}),
      entry("welcome", "Welcome", {}, "Recent files, the bundled meshes and the guided demos.",
            emits(action::ShowWelcome{}),
            {.blocked = unless([](const PanelContext& c) { return c.session.document(); },
                               "It is shown already."),
             .starts_section = true}),
      entry("about", "About winslow", {}, "Versions, graphics and licence.",
            emits(action::ShowAbout{})),
  };
}

namespace {

std::vector<UserCommand> all_demos(const PanelContext&) {
  std::vector<UserCommand> items;
  for (const Demo& demo : demos())
    items.push_back(entry("demo/" + demo.id, "Case " + demo.id + ": " + demo.title, {},
                          "Play this case of the paper step by step.",
                          emits(action::StartDemo{demo.id})));
  return items;
}

}  // namespace

std::vector<UserCommand> demo_commands() {
  const auto without_demo =
      unless([](const PanelContext& c) { return c.demo.demo(); }, "No demo is being played.");
  const auto cannot_step =
      first_of({without_demo, unless([](const PanelContext& c) { return c.demo.ready(c.session); },
                                     "The step is not done yet.")});
  return {
      submenu("demos", "Guided demos", "The cases of the paper, step by step.", all_demos,
              {.words = "tutorial example tour",
               .blocked = unless([](const PanelContext&) { return !assets_folder().empty(); },
                                 "The bundled meshes are not installed."),
               .starts_section = true}),
      entry("demo_next", "Next step of the demo", {key(GLFW_KEY_PAGE_DOWN)}, "On to the next step.",
            emits(action::StepDemo{1}), {.blocked = cannot_step}),
      entry("demo_back", "Step back in the demo", {key(GLFW_KEY_PAGE_UP)},
            "Back to where the step before had ended.", emits(action::StepDemo{-1}),
            {.blocked = cannot_step}),
      entry("demo_end", "End the demo", {key(GLFW_KEY_ESCAPE)},
            "Leave the demo; the mesh stays open.", emits(action::EndDemo{}),
            {.blocked =
                 first_of({without_demo,
                           unless([](const PanelContext& c) { return !c.session.job().active(); },
                                  "Esc cancels the solver now.")})}),
  };
}

}  // namespace winslow::gui
