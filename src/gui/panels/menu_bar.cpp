#include "gui/panels/menu_bar.h"

#include <string>

#include "gui/menu/user_command.h"
#include "gui/widgets/controls.h"

namespace winslow::gui {

namespace {

void draw_entry(const UserCommand& command, const PanelContext& context) {
  const std::string reason = why_blocked(command, context);
  const std::string label = label_of(command, context) + "###" + command.id;
  if (command.items) {
    const bool open = ImGui::BeginMenu(label.c_str(), reason.empty());
    ui::note("menu/" + command.id);
    if (!open) return ui::tooltip(reason.empty() ? command.tooltip : reason);
    for (const UserCommand& item : command.items(context)) {
      if (item.starts_section) ImGui::Separator();
      draw_entry(item, context);
    }
    return ImGui::EndMenu();
  }
  const bool checked = command.checked && command.checked(context);
  const bool pressed =
      ImGui::MenuItem(label.c_str(), chords_text(command.keys).c_str(), checked, reason.empty());
  ui::note("menu/" + command.id);
  ui::tooltip(reason.empty() ? command.tooltip : reason);
  if (pressed) command.run(context);
}

}  // namespace

void MenuBar::draw(const PanelContext& context) {
  for (CommandGroup group : {CommandGroup::file, CommandGroup::edit, CommandGroup::solver,
                             CommandGroup::view, CommandGroup::help}) {
    const std::string name(group_label(group));
    const bool open = ImGui::BeginMenu(name.c_str());
    ui::note("menu/" + name);
    if (!open) continue;
    for (const UserCommand& command : user_commands()) {
      if (command.group != group) continue;
      if (command.starts_section) ImGui::Separator();
      draw_entry(command, context);
    }
    ImGui::EndMenu();
  }
}

}  // namespace winslow::gui
