#include "gui/panels/context_menu.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include "gui/menu/context_commands.h"
#include "gui/panels/menu_entry.h"
#include "gui/widgets/controls.h"

namespace winslow::gui {

namespace {

constexpr const char* context_popup = "###context_menu";

void draw_part(const ContextPart& part, const PanelContext& context) {
  if (!part.title.empty()) {
    const float widest = context.theme.px(260);
    ImGui::PushFont(context.theme.bold);
    ImGui::TextUnformatted(ui::elided(part.title, widest).c_str());
    ImGui::PopFont();
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
  // Undo, a job's end or another file may bring a mesh that has no such node while the menu is
  // open.
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
