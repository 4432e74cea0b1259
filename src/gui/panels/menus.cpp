#include "gui/panels/dialogs.h"
#include "gui/panels/panels.h"

#include "gui/widgets/controls.h"

namespace winslow::gui {

namespace {

/// Draws a command, or a submenu of commands, as an entry of the open menu, with the id "menu/ID".
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

}  // namespace

void draw_menu_bar(const PanelContext& context) {
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

namespace {

constexpr const char* context_popup = "###context_menu";

void draw_part(const ContextPart& part, const PanelContext& context) {
  if (!part.title.empty()) {
    const float widest = context.theme.px(260);
    ui::text_in(context.theme.bold, ui::elided(part.title, widest));
    ui::note("menu_title/" + part.title);
    ui::tooltip(part.title);
  }
  bool first = true;
  for (const UserCommand& command : part.commands) {
    if (command.starts_section && !first) ImGui::Separator();
    first = false;
    draw_menu_entry(command, context);
  }
}

}  // namespace

void ContextMenu::open(const PickedPlace& place) {
  place_ = place;
  wanted_ = true;
}

void ContextMenu::draw(const PanelContext& context) {
  if (wanted_) {
    ImGui::OpenPopup(context_popup);
    topology_ = context.session.topology();
  }
  wanted_ = false;
  const float gap = context.theme.px(8);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(gap, gap));
  const bool shown = ImGui::BeginPopup(context_popup);
  ImGui::PopStyleVar();
  if (!shown) {
    topology_.reset();
    return;
  }
  if (ImGui::IsKeyPressed(GLFW_KEY_ESCAPE, false)) ImGui::CloseCurrentPopup();
  // While the menu is open, undo, the end of a job or another file may change the mesh, so that its
  // items no longer exist.
  const bool same_mesh = context.session.topology() == topology_;
  const auto parts = same_mesh ? context_parts(context, place_) : std::vector<ContextPart>();
  for (std::size_t k = 0; k < parts.size(); ++k) {
    if (k > 0) ImGui::Separator();
    draw_part(parts[k], context);
  }
  if (parts.empty()) ImGui::CloseCurrentPopup();
  ImGui::EndPopup();
}

}  // namespace winslow::gui
