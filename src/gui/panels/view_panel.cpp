#include "gui/panels/view_panel.h"

#include <algorithm>
#include <array>

#include "gui/render/color_map.h"
#include "gui/widgets/controls.h"

namespace winslow::gui {

namespace {

constexpr std::array<Metric, 4> metrics{Metric::normalized_jacobian, Metric::aspect_ratio,
                                        Metric::condition_number, Metric::area};

}  // namespace

void ViewPanel::draw(const PanelContext& context) {
  if (!ui::section("section/view", "View")) return;
  ViewOptions view = context.view;
  bool changed = draw_color(view);
  if (view.color) changed |= draw_range(view);
  changed |= ui::checkbox("view/wireframe", "Edges", view.wireframe);
  ImGui::SameLine(ImGui::GetWindowContentRegionMax().x * 0.5f);
  changed |= ui::checkbox("view/nodes", "Nodes", view.nodes);
  changed |= ui::checkbox("view/inverted", "Inverted in red", view.mark_inverted,
                          "Draw inverted elements in red above all others.");
  ImGui::SameLine(ImGui::GetWindowContentRegionMax().x * 0.5f);
  changed |= ui::checkbox("view/legend", "Legend", view.legend);
  if (changed) context.emit(action::SetView{view});
}

bool ViewPanel::draw_color(ViewOptions& view) {
  std::vector<std::string> names{"None"};
  std::size_t chosen = 0;
  for (std::size_t i = 0; i < metrics.size(); ++i) {
    names.emplace_back(metric_label(metrics[i]));
    if (view.color == metrics[i]) chosen = i + 1;
  }
  constexpr const char* tip = "Colour each element by its quality.";
  ui::row("Colour by", tip);
  if (!ui::combo("view/color", names, chosen, tip)) return false;
  view.color = chosen == 0 ? std::nullopt : std::optional<Metric>(metrics[chosen - 1]);
  view.range.reset();
  return true;
}

bool ViewPanel::draw_range(ViewOptions& view) {
  bool changed = false;
  const auto maps = color_map_names();
  auto map =
      static_cast<std::size_t>(std::find(maps.begin(), maps.end(), view.color_map) - maps.begin());
  ui::row("Colour map");
  if (ui::combo("view/map", maps, map,
                "All maps are even steps to the eye and colour-blind safe.")) {
    view.color_map = maps[map];
    changed = true;
  }
  bool automatic = !view.range;
  constexpr const char* tip = "Range of the colours. Automatic follows the mesh.";
  ui::row("Range", tip);
  if (ui::checkbox("view/range_auto", "Automatic", automatic, tip)) {
    view.range = automatic ? std::nullopt : std::optional(std::array<double, 2>{0.0, 1.0});
    changed = true;
  }
  if (view.range) {
    const float gap = ImGui::GetStyle().ItemInnerSpacing.x;
    ui::row("");
    const float width = (ImGui::GetContentRegionAvail().x - gap) / 2;
    ImGui::SetNextItemWidth(width);
    changed |= ui::number("view/range_low", (*view.range)[0], "Colour of the low end");
    ImGui::SameLine(0, gap);
    ImGui::SetNextItemWidth(width);
    changed |= ui::number("view/range_high", (*view.range)[1], "Colour of the high end");
  }
  return changed;
}

}  // namespace winslow::gui
