#include "gui/panels/dialogs.h"
#include "gui/panels/panels.h"

#include "gui/widgets/controls.h"
#include "gui/widgets/dialog.h"

namespace winslow::gui {

namespace {

struct Answer {
  std::string id, label, tip;
  Action action;
};

template <class A>
Answer answer(const char* id, const char* label, const char* tip, A what) {
  return {std::string("banner/") + id, label, tip, Action(std::move(what))};
}

bool is_bad(const Banner& banner) {
  return banner.kind == Banner::Kind::inverted_result ||
         banner.kind == Banner::Kind::inverted_input;
}

bool can_be_undone(const Banner& banner) {
  return banner.kind == Banner::Kind::inverted_result ||
         banner.kind == Banner::Kind::partial_motion || banner.kind == Banner::Kind::damaged;
}

/// The possible answers to a banner.
std::vector<Answer> answers_to(const Banner& banner) {
  std::vector<Answer> answers;
  if (can_be_undone(banner))
    answers.push_back(
        answer("undo", "Undo", "Back to the mesh before this command.", action::Undo{}));
  else if (banner.kind != Banner::Kind::remark)
    answers.push_back(answer("smooth",
                             banner.kind == Banner::Kind::inverted_input ? "Smooth" : "Go on",
                             "Smooth the mesh, its boundary held.", action::RunSmooth{}));
  if (banner.worst) {
    const bool element = banner.worst->kind == MeshItem::Kind::element;
    answers.push_back(answer("zoom_to_worst", "Zoom to worst",
                             element ? "Go to the worst element: it is marked and fills the view."
                                     : "Go to the wall node whose cell has changed most.",
                             action::GoTo{banner.worst}));
  }
  answers.push_back(answer("keep", is_bad(banner) ? "Keep it" : "Dismiss",
                           "Leave the mesh as it is and hide this line.", action::DismissBanner{}));
  return answers;
}

float width_of(const Answer& answer) {
  return ImGui::CalcTextSize(answer.label.c_str()).x + 2 * ImGui::GetStyle().FramePadding.x;
}

/// Calls `place` for each answer, with true if it begins a new row. Returns the total width on a
/// single row.
template <class Place>
float flow(const std::vector<Answer>& answers, float room, Place&& place) {
  const float gap = ImGui::GetStyle().ItemSpacing.x;
  float all = 0, row = 0;
  for (const Answer& a : answers) {
    const float width = width_of(a);
    const bool wraps = row > 0 && row + gap + width > room;
    place(a, wraps);
    row = wraps || row == 0 ? width : row + gap + width;
    all += (all > 0 ? gap : 0) + width;
  }
  return all;
}

std::string text_of(const PanelContext& context) {
  const std::string icon = context.theme.icon(Icon::warning);
  return (icon.empty() ? "" : icon + "  ") + context.session.messages().banner()->text;
}

float text_gap(const Theme& theme) { return theme.px(16); }

/// The layout of a strip of a given width.
struct Arrangement {
  bool one_line = true;
  int rows = 1;      ///< of answers
  float room = 0;    ///< pixels within the strip
  std::string text;  ///< broken into lines
};

Arrangement arrange(const PanelContext& context, float width) {
  const Theme& theme = context.theme;
  Arrangement a;
  a.room = width - theme.px(2 * banner_padding);
  const std::string whole = text_of(context);
  const float answers = flow(answers_to(*context.session.messages().banner()), a.room,
                             [&](const Answer&, bool wraps) { a.rows += wraps ? 1 : 0; });
  a.one_line = whole.find('\n') == std::string::npos &&
               ImGui::CalcTextSize(whole.c_str()).x + text_gap(theme) + answers <= a.room;
  a.text = a.one_line ? whole : ui::with_line_breaks(whole, a.room);
  return a;
}

}  // namespace

float banner_height(const PanelContext& context, float width) {
  const Theme& theme = context.theme;
  const Arrangement a = arrange(context, width);
  if (a.one_line) return theme.px(44);
  // The text is above the buttons, on as many lines as necessary, since truncation may hide
  // important information.
  const float wrapped = ImGui::CalcTextSize(a.text.c_str(), nullptr, false, a.room).y;
  return theme.px(62) + wrapped +
         static_cast<float>(a.rows - 1) * ImGui::GetFrameHeightWithSpacing();
}

void draw_banner(const PanelContext& context) {
  const auto& banner = context.session.messages().banner();
  if (!banner) return;
  const Arrangement a = arrange(context, ImGui::GetWindowWidth());
  ImGui::AlignTextToFramePadding();
  ImGui::PushTextWrapPos(0);
  ui::text_colored(is_bad(*banner) ? palette().danger : palette().warning, a.text);
  ImGui::PopTextWrapPos();
  ui::note("banner");
  if (a.one_line) ImGui::SameLine(0, text_gap(context.theme));
  bool first = true;
  flow(answers_to(*banner), a.one_line ? INFINITY : a.room, [&](const Answer& answer, bool wraps) {
    if (!first && !wraps) ImGui::SameLine();
    first = false;
    if (ui::button(answer.id, answer.label, {answer.tip})) context.actions.push_back(answer.action);
  });
}

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

/// Draws title and text; they scroll if a small screen would leave no room for the answers.
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
  ImGui::TextUnformatted(ui::readable(prompt.text).c_str());
  ImGui::PopTextWrapPos();
  ImGui::EndChild();
  ui::note("prompt/text");
  ImGui::Spacing();
  ImGui::Spacing();
}

/// Layout of the answers: side by side, or one below the other if there is too little room.
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
  std::vector<float> widths;  // pixels, like all following members
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
    // Enter selects the primary choice, Escape the choice without actions.
    if (pressed || (enter && choice.primary) || (escape && choice.actions.empty()))
      return choose(context, choice);
    if (answers.side_by_side) ImGui::SameLine();
  }
}

}  // namespace

void draw_prompt(const PanelContext& context) {
  const Prompt* prompt = context.session.messages().prompt();
  if (!prompt) return;
  const ImVec2 padding(context.theme.px(20), context.theme.px(16));
  const float room = ui::place_dialog(context.theme.px(440), padding);
  const ui::Modal window(prompt_popup, !ImGui::IsPopupOpen(prompt_popup), context.theme,
                         {ImVec2(20, 16)});
  if (!window.shown()) return;
  const Answers answers(*prompt, context.theme, room);
  const float most = 0.96f * ImGui::GetMainViewport()->Size.y - answers.height - 2 * padding.y;
  draw_text(*prompt, context.theme, room, most);
  draw_choices(context, *prompt, answers, room);
}

}  // namespace winslow::gui
