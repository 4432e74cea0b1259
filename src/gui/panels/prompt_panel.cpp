#include "gui/panels/prompt_panel.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <string>

#include "gui/widgets/controls.h"

namespace winslow::gui {

namespace {

constexpr const char* popup = "###prompt";

ImU32 title_color(Prompt::Kind kind) {
  return kind == Prompt::Kind::error ? palette().danger : palette().text;
}

void choose(const PanelContext& context, const Prompt::Choice& choice) {
  context.emit(action::DismissPrompt{});
  for (const Action& a : choice.actions) context.actions.push_back(a);
  ImGui::CloseCurrentPopup();
}

void draw_text(const Prompt& prompt, const Theme& theme) {
  ImGui::PushFont(theme.bold);
  ui::text_colored(title_color(prompt.kind), prompt.title);
  ImGui::PopFont();
  ImGui::Spacing();
  ImGui::PushTextWrapPos(theme.px(440));
  ImGui::TextUnformatted(prompt.text.c_str());
  ImGui::PopTextWrapPos();
  ui::note("prompt/text");
  ImGui::Spacing();
  ImGui::Spacing();
}

void draw_choices(const PanelContext& context, const Prompt& prompt) {
  float width = 0;
  for (const auto& choice : prompt.choices)
    width += ImGui::CalcTextSize(choice.label.c_str()).x + 2 * ImGui::GetStyle().FramePadding.x +
             context.theme.px(16) + ImGui::GetStyle().ItemSpacing.x;
  ImGui::SetCursorPosX(
      std::max(ImGui::GetCursorPosX(), ImGui::GetWindowContentRegionMax().x - width));
  const bool escape = ImGui::IsKeyPressed(GLFW_KEY_ESCAPE, false);
  const bool enter =
      ImGui::IsKeyPressed(GLFW_KEY_ENTER, false) || ImGui::IsKeyPressed(GLFW_KEY_KP_ENTER, false);
  for (const auto& choice : prompt.choices) {
    const float button = ImGui::CalcTextSize(choice.label.c_str()).x +
                         2 * ImGui::GetStyle().FramePadding.x + context.theme.px(16);
    const auto style = choice.primary ? ui::ButtonStyle::primary : ui::ButtonStyle::normal;
    const bool pressed =
        ui::button("prompt/" + choice.label, choice.label, {"", style, true, button});
    // Enter takes the safe choice; Escape the one that does nothing.
    if (pressed || (enter && choice.primary) || (escape && choice.actions.empty()))
      return choose(context, choice);
    ImGui::SameLine();
  }
}

}  // namespace

void PromptPanel::draw(const PanelContext& context) {
  const Prompt* prompt = context.session.prompt();
  if (!prompt) return;
  if (!ImGui::IsPopupOpen(popup)) ImGui::OpenPopup(popup);
  const ImVec2 centre = ImGui::GetMainViewport()->GetCenter();
  ImGui::SetNextWindowPos(centre, ImGuiCond_Always, ImVec2(0.5f, 0.5f));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding,
                      ImVec2(context.theme.px(20), context.theme.px(16)));
  constexpr auto flags = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_AlwaysAutoResize |
                         ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings;
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, context.theme.px(8));
  if (ImGui::BeginPopupModal(popup, nullptr, flags)) {
    ImGui::Dummy(ImVec2(context.theme.px(360), 0));
    draw_text(*prompt, context.theme);
    draw_choices(context, *prompt);
    ImGui::EndPopup();
  }
  ImGui::PopStyleVar(2);
}

}  // namespace winslow::gui
