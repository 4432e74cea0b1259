#include "gui/widgets/dialog.h"

#include <utility>

#include "gui/base/input.h"
#include "gui/widgets/controls.h"

namespace winslow::gui::ui {

float place_dialog(float wanted, const ImVec2& padding) {
  const ImGuiViewport& screen = *ImGui::GetMainViewport();
  const ImVec2 largest(0.98f * screen.Size.x, 0.98f * screen.Size.y);
  ImGui::SetNextWindowPos(screen.GetCenter(), ImGuiCond_Always, ImVec2(0.5f, 0.5f));
  ImGui::SetNextWindowSizeConstraints(ImVec2(0, 0), largest);
  return std::min(wanted, largest.x - 2 * padding.x - ImGui::GetStyle().ScrollbarSize);
}

Modal::Modal(const char* id, bool open, const Theme& theme, const Look& look) {
  if (open) ImGui::OpenPopup(id);
  const bool fits_content = look.size.x <= 0;
  if (!fits_content) {
    ImGui::SetNextWindowPos(ImGui::GetMainViewport()->GetCenter(), ImGuiCond_Always,
                            ImVec2(0.5f, 0.5f));
    ImGui::SetNextWindowSize(look.size);
  }
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding,
                      ImVec2(theme.px(look.padding.x), theme.px(look.padding.y)));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, theme.px(8));
  const auto flags = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoMove |
                     ImGuiWindowFlags_NoSavedSettings | look.flags |
                     (fits_content ? ImGuiWindowFlags_AlwaysAutoResize : ImGuiWindowFlags_NoResize);
  shown_ = ImGui::BeginPopupModal(id, nullptr, flags);
}

Modal::~Modal() {
  if (shown_) ImGui::EndPopup();
  ImGui::PopStyleVar(2);
}

Dialog::Dialog(const char* id, const std::string& title, bool& wanted, const Theme& theme)
    : theme_(theme),
      width_(place_dialog(theme.px(380), ImVec2(theme.px(20), theme.px(16)))),
      window_(id, std::exchange(wanted, false), theme, {ImVec2(20, 16)}) {
  if (!shown()) return;
  ImGui::Dummy(ImVec2(width_, 0));
  ImGui::PushFont(theme.bold);
  ImGui::TextUnformatted(title.c_str());
  ImGui::PopFont();
  ImGui::Spacing();
}

Dialog::Answer Dialog::buttons(const std::string& id, const std::string& accept, bool enabled) {
  ImGui::Spacing();
  ImGui::Spacing();
  const float space = ImGui::GetStyle().ItemSpacing.x;
  const float width = std::min(theme_.px(130), (width_ - space) / 2);
  ImGui::SetCursorPosX(ImGui::GetWindowContentRegionMax().x - 2 * width - space);
  Answer answer;
  // Esc in a field only reverts the field.
  const bool escape = ImGui::IsKeyPressed(GLFW_KEY_ESCAPE, false) && !ImGui::GetIO().WantTextInput;
  answer.accepted = button(id + "/accept", accept, {"", ButtonStyle::primary, enabled, width});
  ImGui::SameLine();
  answer.cancelled =
      button(id + "/cancel", "Cancel", {"", ButtonStyle::normal, true, width}) || escape;
  if (answer.accepted || answer.cancelled) ImGui::CloseCurrentPopup();
  return answer;
}

}  // namespace winslow::gui::ui
