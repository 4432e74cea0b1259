#include "gui/widgets/dialog.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>

#include "gui/widgets/controls.h"

namespace winslow::gui::ui {

float place_dialog(float wanted, const ImVec2& padding) {
  const ImGuiViewport& screen = *ImGui::GetMainViewport();
  const ImVec2 largest(0.98f * screen.Size.x, 0.98f * screen.Size.y);
  ImGui::SetNextWindowPos(screen.GetCenter(), ImGuiCond_Always, ImVec2(0.5f, 0.5f));
  ImGui::SetNextWindowSizeConstraints(ImVec2(0, 0), largest);
  return std::min(wanted, largest.x - 2 * padding.x - ImGui::GetStyle().ScrollbarSize);
}

Dialog::Dialog(const char* id, const std::string& title, bool& wanted, const Theme& theme)
    : theme_(theme) {
  if (wanted) ImGui::OpenPopup(id);
  wanted = false;
  const ImVec2 padding(theme.px(20), theme.px(16));
  width_ = place_dialog(theme.px(380), padding);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, padding);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, theme.px(8));
  constexpr auto flags = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_AlwaysAutoResize |
                         ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings;
  shown_ = ImGui::BeginPopupModal(id, nullptr, flags);
  if (!shown_) return;
  ImGui::Dummy(ImVec2(width_, 0));
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
  const float space = ImGui::GetStyle().ItemSpacing.x;
  const float width = std::min(theme_.px(130), (width_ - space) / 2);
  ImGui::SetCursorPosX(ImGui::GetWindowContentRegionMax().x - 2 * width - space);
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
