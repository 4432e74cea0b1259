#include "gui/panels/menu_entry.h"

#include <string>

#include "gui/widgets/controls.h"

namespace winslow::gui {

void draw_menu_entry(const UserCommand& command, const PanelContext& context) {
  const std::string reason = why_blocked(command, context);
  const std::string label = label_of(command, context) + "###" + command.id;
  if (command.items) {
    const bool open = ImGui::BeginMenu(label.c_str(), reason.empty());
    ui::note("menu/" + command.id);
    if (!open) return ui::tooltip(reason.empty() ? command.tooltip : reason);
    for (const UserCommand& item : command.items(context)) {
      if (item.starts_section) ImGui::Separator();
      draw_menu_entry(item, context);
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

}  // namespace winslow::gui
