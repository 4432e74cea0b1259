#include "gui/widgets/height_plot.h"

#include <algorithm>
#include <string>

#include "gui/base/text.h"
#include "gui/widgets/controls.h"
#include "gui/widgets/plot_frame.h"

namespace winslow::gui::ui {

void height_plot(std::string_view id, const LayerHeights& heights, const Theme& theme) {
  const std::size_t count = std::max(heights.wanted.size(), heights.realised.size());
  if (count == 0) return;
  double highest = 0;
  for (const auto* values : {&heights.wanted, &heights.realised})
    for (const double h : *values) highest = std::max(highest, h);
  if (!(highest > 0)) return;
  const float width = ImGui::GetContentRegionAvail().x;
  const float height = theme.px(86);
  const ImVec2 min = ImGui::GetCursorScreenPos();
  const ImVec2 max(min.x + width, min.y + height);
  ImGui::Dummy(ImVec2(width, height));
  note(id);
  tooltip(
      "Height of each layer, from the wall outwards: wanted (line) and, where layers are in, "
      "realised (dots).");
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled(min, max, palette().card, theme.px(4));
  list.AddRect(min, max, palette().border, theme.px(4));
  const float pad = theme.px(10);
  const PlotStrip strip{ImVec2(min.x + pad, min.y + pad + theme.px(12)),
                        ImVec2(max.x - pad, max.y - pad), 0.5, static_cast<double>(count) + 0.5};
  const PlotAxis axis{0, highest, false};
  std::vector<ImVec2> line;
  for (std::size_t k = 0; k < heights.wanted.size(); ++k)
    line.emplace_back(strip.x(static_cast<double>(k + 1)), strip.y(axis, heights.wanted[k]));
  list.AddPolyline(line.data(), static_cast<int>(line.size()), palette().accent, 0, theme.px(1.5f));
  for (std::size_t k = 0; k < heights.realised.size(); ++k)
    list.AddCircleFilled(
        ImVec2(strip.x(static_cast<double>(k + 1)), strip.y(axis, heights.realised[k])),
        theme.px(2.5f), palette().text);
  text_at(list, ImVec2(min.x + pad, min.y + theme.px(4)), ImVec2(0, 0), palette().text_dim,
          "height, up to " + short_number(highest));
  text_at(list, ImVec2(max.x - pad, min.y + theme.px(4)), ImVec2(1, 0), palette().text_dim,
          counted(count, "layer"));
}

}  // namespace winslow::gui::ui
