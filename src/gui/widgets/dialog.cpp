#include "gui/widgets/dialog.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include "gui/widgets/controls.h"

namespace winslow::gui::ui {

Dialog::Dialog(const char* id, const std::string& title, bool& wanted, const Theme& theme)
    : theme_(theme) {
  if (wanted) ImGui::OpenPopup(id);
  wanted = false;
  ImGui::SetNextWindowPos(ImGui::GetMainViewport()->GetCenter(), ImGuiCond_Always,
                          ImVec2(0.5f, 0.5f));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(theme.px(20), theme.px(16)));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, theme.px(8));
  constexpr auto flags = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_AlwaysAutoResize |
                         ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings;
  shown_ = ImGui::BeginPopupModal(id, nullptr, flags);
  if (!shown_) return;
  ImGui::Dummy(ImVec2(theme.px(380), 0));
  ImGui::PushFont(theme.bold);
  ImGui::TextUnformatted(title.c_str());
  ImGui::PopFont();
  ImGui::Spacing();
}

Dialog::~Dialog() {
  if (shown_) ImGui::EndPopup();
  ImGui::PopStyleVar(2);
}

Dialog::Answer Dialog::buttons(const std::string& id, const std::string& accept, bool enabled) {
  ImGui::Spacing();
  ImGui::Spacing();
  const float width = theme_.px(130);
  ImGui::SetCursorPosX(ImGui::GetWindowContentRegionMax().x - 2 * width -
                       ImGui::GetStyle().ItemSpacing.x);
  Answer answer;
  // Esc in a field takes back what was typed, and no more.
  const bool escape = ImGui::IsKeyPressed(GLFW_KEY_ESCAPE, false) && !ImGui::GetIO().WantTextInput;
  answer.accepted = button(id + "/accept", accept, {"", ButtonStyle::primary, enabled, width});
  ImGui::SameLine();
  answer.cancelled =
      button(id + "/cancel", "Cancel", {"", ButtonStyle::normal, true, width}) || escape;
  if (answer.accepted || answer.cancelled) ImGui::CloseCurrentPopup();
  return answer;
}

}  // namespace winslow::gui::ui
