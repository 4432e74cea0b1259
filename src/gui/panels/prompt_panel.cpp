#include "gui/panels/prompt_panel.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <string>
#include <vector>

#include "gui/widgets/controls.h"
#include "gui/widgets/dialog.h"

namespace winslow::gui {

namespace {

constexpr const char* prompt_popup = "###prompt";

ImU32 title_color(Prompt::Kind kind) {
  return kind == Prompt::Kind::error ? palette().danger : palette().text;
}

void choose(const PanelContext& context, const Prompt::Choice& choice) {
  context.emit(action::DismissPrompt{});
  for (const Action& a : choice.actions) context.actions.push_back(a);
  ImGui::CloseCurrentPopup();
}

/// Height of a text in lines of at most this width.
float height_of(const std::string& text, float width) {
  return ImGui::CalcTextSize(text.c_str(), nullptr, false, width).y;
}

/// Title and text, which scroll where a small screen would leave no room for the answers.
void draw_text(const Prompt& prompt, const Theme& theme, float width, float most) {
  const float wrapped = width - ImGui::GetStyle().ScrollbarSize;
  const float gap = 2 * ImGui::GetStyle().ItemSpacing.y;
  ImGui::PushFont(theme.bold);
  const float title = height_of(prompt.title, wrapped);
  ImGui::PopFont();
  const float whole = title + gap + height_of(prompt.text, wrapped);
  ImGui::BeginChild("text", ImVec2(width, std::min(whole, most)));
  ImGui::PushTextWrapPos(wrapped);
  ImGui::PushFont(theme.bold);
  ui::text_colored(title_color(prompt.kind), prompt.title);
  ImGui::PopFont();
  ImGui::SetCursorPosY(title + gap);
  ImGui::TextUnformatted(prompt.text.c_str());
  ImGui::PopTextWrapPos();
  ImGui::EndChild();
  ui::note("prompt/text");
  ImGui::Spacing();
  ImGui::Spacing();
}

/// Side by side, or one below the other where there is no room for that.
struct Answers {
  Answers(const Prompt& prompt, const Theme& theme, float room) {
    const ImGuiStyle& style = ImGui::GetStyle();
    for (const auto& choice : prompt.choices) {
      widths.push_back(ImGui::CalcTextSize(choice.label.c_str()).x + 2 * style.FramePadding.x +
                       theme.px(16));
      total += widths.back() + style.ItemSpacing.x;
    }
    total -= style.ItemSpacing.x;
    side_by_side = total <= room;
    const auto rows = static_cast<float>(side_by_side ? 1 : prompt.choices.size());
    height = rows * ImGui::GetFrameHeightWithSpacing() + 2 * style.ItemSpacing.y;
  }
  std::vector<float> widths;  // pixels, as all that follows
  float total = 0, height = 0;
  bool side_by_side = true;
};

void draw_choices(const PanelContext& context, const Prompt& prompt, const Answers& answers,
                  float room) {
  if (answers.side_by_side)
    ImGui::SetCursorPosX(ImGui::GetCursorPosX() + std::max(0.0f, room - answers.total));
  const bool escape = ImGui::IsKeyPressed(GLFW_KEY_ESCAPE, false);
  const bool enter =
      ImGui::IsKeyPressed(GLFW_KEY_ENTER, false) || ImGui::IsKeyPressed(GLFW_KEY_KP_ENTER, false);
  for (std::size_t i = 0; i < prompt.choices.size(); ++i) {
    const auto& choice = prompt.choices[i];
    const auto style = choice.primary ? ui::ButtonStyle::primary : ui::ButtonStyle::normal;
    const float width = answers.side_by_side ? answers.widths[i] : room;
    const bool pressed =
        ui::button("prompt/" + choice.label, choice.label, {"", style, true, width});
    // Enter takes the safe choice; Escape the one that does nothing.
    if (pressed || (enter && choice.primary) || (escape && choice.actions.empty()))
      return choose(context, choice);
    if (answers.side_by_side) ImGui::SameLine();
  }
}

}  // namespace

void PromptPanel::draw(const PanelContext& context) {
  const Prompt* prompt = context.session.messages().prompt();
  if (!prompt) return;
  if (!ImGui::IsPopupOpen(prompt_popup)) ImGui::OpenPopup(prompt_popup);
  const ImVec2 padding(context.theme.px(20), context.theme.px(16));
  const float room = ui::place_dialog(context.theme.px(440), padding);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, padding);
  constexpr auto flags = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_AlwaysAutoResize |
                         ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings;
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, context.theme.px(8));
  if (ImGui::BeginPopupModal(prompt_popup, nullptr, flags)) {
    const Answers answers(*prompt, context.theme, room);
    const float most = 0.96f * ImGui::GetMainViewport()->Size.y - answers.height - 2 * padding.y;
    draw_text(*prompt, context.theme, room, most);
    draw_choices(context, *prompt, answers, room);
    ImGui::EndPopup();
  }
  ImGui::PopStyleVar(2);
}

}  // namespace winslow::gui
