#include "gui/widgets/list_rows.h"

#include <algorithm>

#include "gui/widgets/controls.h"

namespace winslow::gui::ui {

namespace {

float row_height(const Theme& theme) { return 2 * ImGui::GetTextLineHeight() + theme.px(10); }

}  // namespace

RowAnswer draw_list_row(const ListRow& row, const Theme& theme) {
  const float pad = theme.px(6), cross = theme.px(26), line = ImGui::GetTextLineHeight();
  const ImVec2 start = ImGui::GetCursorScreenPos();
  const ImVec2 size(ImGui::GetContentRegionAvail().x - cross, row_height(theme));
  const bool pressed = ImGui::InvisibleButton(row.id.c_str(), size);
  note(row.id);
  const bool over = ImGui::IsItemHovered();
  tooltip(row.tip);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  if (row.selected || over)
    list.AddRectFilled(start, ImVec2(start.x + size.x, start.y + size.y), palette().accent_soft,
                       theme.px(4));
  const auto text = [&](float y, const std::string& what, ImU32 color) {
    list.AddText(ImVec2(start.x + pad, start.y + theme.px(4) + y), color,
                 elided(what, size.x - 2 * pad).c_str());
  };
  text(0, row.title, palette().text);
  text(line + theme.px(2), row.summary, palette().text_dim);
  ImGui::SetCursorScreenPos(
      ImVec2(start.x + size.x, start.y + (size.y - ImGui::GetFrameHeight()) / 2));
  const bool removed =
      button(row.id + "/remove", "\xC3\x97", {row.remove_tip, ButtonStyle::flat, true, cross});
  ImGui::SetCursorScreenPos(ImVec2(start.x, start.y + size.y));
  ImGui::Dummy(ImVec2(0, 0));  // registers the position of the next row
  if (removed) return RowAnswer::removed;
  return pressed ? RowAnswer::pressed : RowAnswer::none;
}

void draw_list(const char* id, std::size_t count, const Theme& theme,
               const std::function<bool(std::size_t)>& draw) {
  if (count == 0) return;
  const auto rows = static_cast<float>(std::min<std::size_t>(count, 5));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(2, 2));
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, ImVec2(0, 0));
  ImGui::BeginChild(id, ImVec2(0, row_height(theme) * rows + theme.px(6)), true);
  for (std::size_t k = 0; k < count && draw(k); ++k) {
  }
  ImGui::EndChild();
  ImGui::PopStyleVar(2);
  ImGui::Spacing();  // adds spacing after the list
}

}  // namespace winslow::gui::ui
