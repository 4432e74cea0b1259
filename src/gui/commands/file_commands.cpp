#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include "gui/commands/user_command.h"

namespace winslow::gui {

namespace {

std::string cannot_save(const PanelContext& context) {
  if (context.session.saving()) return "The mesh is being saved.";
  return while_busy(context);
}

std::function<void(const PanelContext&)> dialog(action::FilePurpose purpose) {
  return [purpose](const PanelContext& c) { c.emit(action::ShowFileDialog{purpose}); };
}

}  // namespace

std::vector<UserCommand> file_commands() {
  using action::FilePurpose;
  constexpr auto group = CommandGroup::file;
  return {
      {.id = "open",
       .label = "Open mesh...",
       .group = group,
       .keys = {control(key(GLFW_KEY_O))},
       .tooltip = "Choose a mesh file. A file dropped on the window opens, too.",
       .run = dialog(FilePurpose::open_mesh)},
      {.id = "save",
       .label = "Save",
       .group = group,
       .keys = {control(key(GLFW_KEY_S))},
       .tooltip = "Save the mesh.",
       .blocked = cannot_save,
       .run = [](const PanelContext& c) { c.emit(action::SaveMesh{}); },
       .starts_section = true},
      {.id = "save_as",
       .label = "Save as...",
       .group = group,
       .keys = {control(shift(key(GLFW_KEY_S)))},
       .tooltip = "Save the mesh under another name or in another format.",
       .blocked = cannot_save,
       .run = dialog(FilePurpose::save_mesh)},
      {.id = "recipe",
       .label = "Export recipe...",
       .group = group,
       .keys = {control(key(GLFW_KEY_E))},
       .tooltip = "Write the commands of this session to a file that \"winslow replay\" runs.",
       .blocked = [](const PanelContext& c) -> std::string {
         if (!c.session.document()) return without_mesh(c);
         return c.session.document()->history().position() > 0 ? "" : "Nothing was done yet.";
       },
       .run = dialog(FilePurpose::export_recipe)},
      {.id = "replay",
       .label = "Replay recipe...",
       .group = group,
       .tooltip = "Apply the commands of a recipe to the open mesh, one after the other.",
       .blocked = [](const PanelContext& c) -> std::string {
         if (!c.session.document()) return without_mesh(c);
         return c.session.in_motion() ? "Wait until the solver is done, or cancel it." : "";
       },
       .run = dialog(FilePurpose::replay_recipe)},
      {.id = "export_convergence",
       .label = "Export iterations...",
       .group = group,
       .tooltip = "Write the iterations that the plot shows as a CSV table.",
       .blocked = [](const PanelContext& c) -> std::string {
         return c.session.convergence().empty() ? "There are no iterations yet." : "";
       },
       .run = dialog(FilePurpose::export_convergence)},
      {.id = "screenshot",
       .label = "Save picture",
       .group = group,
       .keys = {key(GLFW_KEY_F12)},
       .tooltip = "Save a picture of this window.",
       .run = [](const PanelContext& c) { c.emit(action::TakeScreenshot{}); },
       .starts_section = true},
      {.id = "screenshot_as",
       .label = "Save picture as...",
       .group = group,
       .keys = {shift(key(GLFW_KEY_F12))},
       .tooltip = "Save a picture of this window under a name.",
       .run = dialog(FilePurpose::screenshot)},
      {.id = "quit",
       .label = "Quit",
       .group = group,
       .keys = {control(key(GLFW_KEY_Q))},
       .tooltip = "Leave the studio. It asks if there are changes that are not saved.",
       .run = [](const PanelContext& c) { c.emit(action::Quit{}); },
       .starts_section = true},
  };
}

}  // namespace winslow::gui
