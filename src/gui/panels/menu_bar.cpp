#include "gui/panels/menu_bar.h"

#include <string>

#include "gui/panels/menu_entry.h"
#include "gui/widgets/controls.h"

namespace winslow::gui {

void MenuBar::draw(const PanelContext& context) {
  for (const CommandGroup group : command_groups) {
    const std::string name(group_label(group));
    const bool open = ImGui::BeginMenu(name.c_str());
    ui::note("menu/" + name);
    if (!open) continue;
    for (const UserCommand& command : user_commands()) {
      if (command.group != group) continue;
      if (command.starts_section) ImGui::Separator();
      draw_menu_entry(command, context);
    }
    ImGui::EndMenu();
  }
}

}  // namespace winslow::gui
