#include "gui/panels/dialogs.h"

#include <imgui_stdlib.h>

#include "gui/widgets/controls.h"

namespace winslow::gui {

namespace {

constexpr const char* palette_popup = "###command_palette";
constexpr std::size_t remembered = 5;

}  // namespace

std::vector<CommandPalette::Row> CommandPalette::rows(const PanelContext& context) const {
  std::vector<Row> found;
  const auto add = [&](const UserCommand& command, const std::string& prefix,
                       const std::string& blocked) {
    Row row{command, prefix + label_of(command, context), why_blocked(command, context), 0};
    if (row.reason.empty()) row.reason = blocked;
    const auto score = search_score(query_, row.label,
                                    command.words + ' ' + std::string(group_label(command.group)));
    if (!score) return;
    const auto place = std::find(recent_.begin(), recent_.end(), command.id) - recent_.begin();
    const auto rank = static_cast<int>(recent_.size()) - static_cast<int>(place);
    row.score = *score + (query_.empty() ? rank : 32 * rank);
    found.push_back(std::move(row));
  };
  for (const UserCommand& command : user_commands()) {
    if (command.id == "palette") continue;
    if (!command.items) {
      add(command, "", "");
      continue;
    }
    const std::string blocked = why_blocked(command, context);
    for (const UserCommand& item : command.items(context)) {
      UserCommand listed = item;
      listed.group = command.group;
      listed.words += ' ' + command.words;
      add(listed, command.label + ": ", blocked);
    }
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const Row& a, const Row& b) { return a.score > b.score; });
  // Use matches by letters only if no command matches by words, since they match too many commands.
  if (!query_.empty() && !found.empty() && found.front().score >= found_by_words)
    std::erase_if(found, [](const Row& row) { return row.score < found_by_words; });
  return found;
}

void CommandPalette::draw(const PanelContext& context) {
  const Theme& theme = context.theme;
  if (wanted_) {
    ImGui::OpenPopup(palette_popup);
    query_.clear();
    chosen_ = 0;
    scroll_ = true;
  }
  wanted_ = false;
  const ImVec2 screen = ImGui::GetMainViewport()->Size;
  ImGui::SetNextWindowPos(ImVec2(screen.x / 2, 0.1f * screen.y), ImGuiCond_Always, ImVec2(0.5f, 0));
  ImGui::SetNextWindowSize(
      ImVec2(std::min(theme.px(600), 0.94f * screen.x), std::min(theme.px(430), 0.8f * screen.y)));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(theme.px(12), theme.px(12)));
  ImGui::PushStyleVar(ImGuiStyleVar_PopupRounding, theme.px(8));
  if (ImGui::BeginPopup(palette_popup,
                        ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings)) {
    draw_query(context);
    const std::vector<Row> all = rows(context);
    draw_rows(context, all);
    const bool enter =
        ImGui::IsKeyPressed(GLFW_KEY_ENTER, false) || ImGui::IsKeyPressed(GLFW_KEY_KP_ENTER, false);
    if (enter && chosen_ < all.size()) run(context, all[chosen_]);
    if (ImGui::IsKeyPressed(GLFW_KEY_ESCAPE, false)) ImGui::CloseCurrentPopup();
    ImGui::EndPopup();
  }
  ImGui::PopStyleVar(2);
}

void CommandPalette::draw_query(const PanelContext& context) {
  if (ImGui::IsWindowAppearing()) ImGui::SetKeyboardFocusHere();
  ImGui::SetNextItemWidth(-FLT_MIN);
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding,
                      ImVec2(context.theme.px(10), context.theme.px(8)));
  if (ImGui::InputTextWithHint("##query", "What do you want to do?", &query_)) {
    chosen_ = 0;
    scroll_ = true;
  }
  ui::note("palette_query");
  ImGui::PopStyleVar();
}

void CommandPalette::draw_rows(const PanelContext& context, const std::vector<Row>& rows) {
  if (rows.empty())
    return ui::text_dim("No command has these words, or these letters in this order.");
  const auto last = rows.size() - 1;
  const auto move = [&](std::size_t to) {
    chosen_ = to;
    scroll_ = true;
  };
  if (ImGui::IsKeyPressed(GLFW_KEY_DOWN)) move(chosen_ >= last ? 0 : chosen_ + 1);
  if (ImGui::IsKeyPressed(GLFW_KEY_UP)) move(chosen_ == 0 ? last : chosen_ - 1);
  if (ImGui::IsKeyPressed(GLFW_KEY_PAGE_DOWN)) move(std::min(chosen_ + 8, last));
  if (ImGui::IsKeyPressed(GLFW_KEY_PAGE_UP)) move(chosen_ - std::min<std::size_t>(chosen_, 8));
  chosen_ = std::min(chosen_, last);
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, ImVec2(0, context.theme.px(1)));
  ImGui::BeginChild("rows");
  const Row* pressed = nullptr;
  for (std::size_t k = 0; k < rows.size(); ++k)
    if (draw_row(context, rows[k], k == chosen_)) pressed = &rows[k];
  ImGui::EndChild();
  ImGui::PopStyleVar();
  if (pressed) run(context, *pressed);
}

bool CommandPalette::draw_row(const PanelContext& context, const Row& row, bool chosen) {
  const Theme& theme = context.theme;
  const ImVec2 start = ImGui::GetCursorScreenPos();
  const ImVec2 size(ImGui::GetContentRegionAvail().x, ImGui::GetTextLineHeight() + 2 * theme.px(6));
  const ImVec2 end(start.x + size.x, start.y + size.y);
  const bool pressed = ImGui::InvisibleButton(row.command.id.c_str(), size);
  ui::note("palette/" + row.command.id, start, end);
  if (chosen && scroll_) {
    ImGui::SetScrollHereY(0.5f);
    scroll_ = false;
  }
  ImDrawList& list = *ImGui::GetWindowDrawList();
  if (chosen || ImGui::IsItemHovered())
    list.AddRectFilled(start, end, chosen ? palette().accent_soft : palette().grid, theme.px(5));
  ui::tooltip(row.command.tooltip);
  const bool can = row.reason.empty();
  const float pad = theme.px(8);
  // At the right the keys, or why it is unavailable; at the left the menu that contains it.
  const std::string right = can ? chords_text(row.command.keys) : row.reason;
  const float right_width = ImGui::CalcTextSize(right.c_str()).x;
  const float y = start.y + theme.px(6);
  list.AddText(ImVec2(end.x - pad - right_width, y), palette().text_faint, right.c_str());
  std::string label = row.label;
  if (row.command.checked && row.command.checked(context)) label += "  (on)";
  const std::string group(group_label(row.command.group));
  const float group_width = theme.px(58);
  list.AddText(ImVec2(start.x + pad, y), palette().text_faint, group.c_str());
  const float room = size.x - 3 * pad - group_width - right_width;
  list.AddText(ImVec2(start.x + pad + group_width, y), can ? palette().text : palette().text_faint,
               ui::elided(label, room).c_str());
  return pressed;
}

void CommandPalette::run(const PanelContext& context, const Row& row) {
  if (!row.reason.empty()) return;  // the row says why not
  std::erase(recent_, row.command.id);
  recent_.push_front(row.command.id);
  if (recent_.size() > remembered) recent_.pop_back();
  ImGui::CloseCurrentPopup();
  row.command.run(context);
}

}  // namespace winslow::gui
