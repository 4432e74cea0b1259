#include "gui/panels/layers/layer_result.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "gui/base/text.h"
#include "gui/widgets/controls.h"

namespace winslow::gui {

namespace {

std::string column_text(const LayerColumn& column) {
  return "n" + std::to_string(column.wall_node) + "  " + short_number(column.thickness()) + "  " +
         std::string(limit_name(column.limit));
}

/// The columns on the selected markers; all, where these have none.
std::vector<const LayerColumn*> shown_columns(const Session& session, const LayerStack& stack) {
  std::vector<const LayerColumn*> all, selected;
  for (const LayerColumn& column : stack.columns) {
    all.push_back(&column);
    for (const Index marker : session.selection().markers())
      if (std::ranges::binary_search(session.topology()->markers().nodes(marker),
                                     column.wall_node)) {
        selected.push_back(&column);
        break;
      }
  }
  return selected.empty() ? all : selected;
}

/// Height of each layer as wanted and as it came out, on average over the columns that have it.
ui::LayerHeights mean_heights(const std::vector<const LayerColumn*>& columns,
                              const Coordinates& x) {
  ui::LayerHeights sums;
  std::vector<double> count;
  for (const LayerColumn* column : columns) {
    if (count.size() < column->count())
      for (auto* values : {&sums.wanted, &sums.realised, &count}) values->resize(column->count());
    for (std::size_t k = 0; k + 1 < column->nodes.size(); ++k) {
      const Vec2 edge = x.xy(column->nodes[k + 1]) - x.xy(column->nodes[k]);
      sums.wanted[k] += column->heights[k];
      sums.realised[k] += edge.norm() / column->slant;
      count[k] += 1;
    }
  }
  for (std::size_t k = 0; k < count.size(); ++k) {
    sums.wanted[k] /= std::max(count[k], 1.0);
    sums.realised[k] /= std::max(count[k], 1.0);
  }
  return sums;
}

}  // namespace

void LayerResult::measure(const PanelContext& context) {
  const Session& session = context.session;
  auto stack = session.mesh().layers();
  if (stack == stack_ && shape_ == session.shape() && selection_ == session.selection().markers())
    return;
  stack_ = std::move(stack);
  shape_ = session.shape();
  selection_ = session.selection().markers();
  if (!stack_) return;
  measures_ = measure_layers(*stack_, session.coordinates());
  heights_ = mean_heights(shown_columns(session, *stack_), session.coordinates());
}

void LayerResult::draw(const PanelContext& context) {
  measure(context);
  if (!stack_) return;
  ui::text_wrapped("This mesh has layers: " + counted(stack_->columns.size(), "column") + ", " +
                   std::to_string(measures_.cut_short) + " cut short, " +
                   short_number(measures_.thickness.min) + " to " +
                   short_number(measures_.thickness.max) + " thick; heights within " +
                   short_number(std::round(1e4 * measures_.spacing_error.max) / 100) +
                   " % of those wanted" + (stack_->held ? ", and held." : "."));
  ui::note("layers/result");
  ui::height_plot("layers/realised", heights_, context.theme);
  if (measures_.cut_short > 0) draw_cut_columns(context);
}

void LayerResult::draw_cut_columns(const PanelContext& context) {
  if (!ui::fold("layers/cut", "Columns cut short",
                "Columns thinner than asked, and why: wall node, thickness, reason."))
    return;
  constexpr std::size_t most = 200;
  const float line = ImGui::GetTextLineHeightWithSpacing();
  ImGui::BeginChild("cut", ImVec2(0, 6 * line), true);
  std::size_t number = 0;
  for (const LayerColumn& column : stack_->columns) {
    if (!cut_short(column)) continue;
    if (number == most) break;
    const std::string id = "layers/cut/" + std::to_string(number++);
    if (ImGui::Selectable((column_text(column) + "##" + id).c_str()))
      context.emit(action::LookAt{context.session.coordinates().xy(column.wall_node),
                                  4 * std::max(column.asked, column.thickness())});
    ui::note(id);
    ui::tooltip("Show this column.");
  }
  ImGui::EndChild();
}

}  // namespace winslow::gui
