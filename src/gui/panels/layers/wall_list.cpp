#include "gui/panels/layers/wall_list.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "gui/studio/text.h"
#include "gui/widgets/controls.h"

namespace winslow::gui {

namespace {

/// "25 layers, first 1e-05, ratio 1.2".
std::string summary(const LayerSpacing& spacing) {
  std::string text = spacing.match_outside ? "layers to match" : counted(spacing.count, "layer");
  text += ", first " + short_number(spacing.first);
  return text + (spacing.total ? ", " + short_number(*spacing.total) + " thick"
                               : ", ratio " + short_number(spacing.ratio));
}

std::vector<Index> indices(const std::vector<std::string>& names, const Topology& topology) {
  std::vector<Index> markers;
  for (const std::string& name : names)
    if (const auto marker = topology.find_marker(name)) markers.push_back(*marker);
  return markers;
}

}  // namespace

std::string marker_list(const std::vector<std::string>& names) {
  std::string text;
  for (const auto& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

LayerWall* WallList::find(const std::vector<std::string>& markers) {
  const auto found = std::ranges::find_if(walls_, [&](const LayerWall& wall) {
    return std::ranges::is_permutation(wall.markers, markers);
  });
  return found == walls_.end() ? nullptr : &*found;
}

void WallList::add(LayerWall wall) {
  for (LayerWall& other : walls_)
    std::erase_if(other.markers, [&](const std::string& name) {
      return std::ranges::find(wall.markers, name) != wall.markers.end();
    });
  std::erase_if(walls_, [](const LayerWall& other) { return other.markers.empty(); });
  walls_.push_back(std::move(wall));
}

void WallList::draw(const PanelContext& context) {
  if (walls_.empty()) return;
  const Theme& theme = context.theme;
  const float row = 2 * ImGui::GetTextLineHeight() + theme.px(10);
  const auto rows = static_cast<float>(std::min<std::size_t>(walls_.size(), 5));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(2, 2));
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, ImVec2(0, 0));
  ImGui::BeginChild("walls", ImVec2(0, row * rows + theme.px(6)), true);
  const std::size_t before = walls_.size();
  for (std::size_t k = 0; k < walls_.size() && walls_.size() == before; ++k) draw_row(context, k);
  ImGui::EndChild();
  ImGui::PopStyleVar(2);
}

void WallList::draw_row(const PanelContext& context, std::size_t k) {
  const Theme& theme = context.theme;
  const LayerWall& wall = walls_[k];
  const std::string id = "layers/wall/" + std::to_string(k);
  const float pad = theme.px(6), cross = theme.px(26), line = ImGui::GetTextLineHeight();
  const ImVec2 start = ImGui::GetCursorScreenPos();
  const ImVec2 size(ImGui::GetContentRegionAvail().x - cross, 2 * line + theme.px(10));
  const bool pressed = ImGui::InvisibleButton(id.c_str(), size);
  ui::note(id);
  const bool over = ImGui::IsItemHovered();
  ui::tooltip(marker_list(wall.markers) + "\n" + summary(wall.spacing) +
              "\nClick to select these markers and change the settings of this wall.");
  std::vector<Index> markers = indices(wall.markers, *context.topology());
  std::ranges::sort(markers);
  const bool shown = markers == context.session.selection();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  if (shown || over)
    list.AddRectFilled(start, ImVec2(start.x + size.x, start.y + size.y), palette().accent_soft,
                       theme.px(4));
  const auto text = [&](float y, const std::string& what, ImU32 color) {
    list.AddText(ImVec2(start.x + pad, start.y + theme.px(4) + y), color,
                 ui::elided(what, size.x - 2 * pad).c_str());
  };
  text(0, marker_list(wall.markers), palette().text);
  text(line + theme.px(2), summary(wall.spacing), palette().text_dim);
  if (pressed) context.emit(action::SelectMarkers{std::move(markers)});
  ImGui::SetCursorScreenPos(
      ImVec2(start.x + size.x, start.y + (size.y - ImGui::GetFrameHeight()) / 2));
  if (ui::button(id + "/remove", "\xC3\x97",
                 {"Take this wall out of the list.", ui::ButtonStyle::flat, true, cross}))
    walls_.erase(walls_.begin() + static_cast<std::ptrdiff_t>(k));
  ImGui::SetCursorScreenPos(ImVec2(start.x, start.y + size.y));
  ImGui::Dummy(ImVec2(0, 0));  // the place of the next row counts as drawn
}

}  // namespace winslow::gui
