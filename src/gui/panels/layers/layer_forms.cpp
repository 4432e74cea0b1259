#include "gui/panels/layers/layer_forms.h"

#include "core/error.h"
#include "gui/base/text.h"

namespace winslow::gui {

namespace {

/// The box around markers.
WallPart box_of(const PanelContext& context, const std::vector<std::string>& names) {
  constexpr double far = std::numeric_limits<double>::infinity();
  WallPart box{far, -far, far, -far};
  for (const Index node : context.topology()->markers().nodes_of(names)) {
    const Vec2 p = context.session.coordinates().xy(node);
    box = {std::min(box.xmin, p.x()), std::max(box.xmax, p.x()), std::min(box.ymin, p.y()),
           std::max(box.ymax, p.y())};
  }
  return box;
}

}  // namespace

void PartForm::draw(const PanelContext& context, const std::vector<std::string>& names) {
  const bool changed =
      ui::checkbox("layers/part", "Only part of the wall", only_,
                   "Layers at those edges only that have both ends in a box. They run out at its "
                   "ends, or stand on the boundary that follows there.");
  if (!only_) return;
  if (changed) part_ = box_of(context, names);
  layer_field("layers/xmin", "From x", part_.xmin, "Left end of the box, in units of the mesh.");
  layer_field("layers/xmax", "To x", part_.xmax, "Right end of the box, in units of the mesh.");
  layer_field("layers/ymin", "From y", part_.ymin, "Lower end of the box, in units of the mesh.");
  layer_field("layers/ymax", "To y", part_.ymax, "Upper end of the box, in units of the mesh.");
}

void PartForm::set(const WallPart& part) {
  only_ = part != WallPart{};
  if (only_) part_ = part;
}

void SpacingForm::draw() {
  constexpr const char* count_tip = "Number of layers.";
  if (!spacing_.match_outside) {
    ui::row("Layers", count_tip, layer_label_share);
    int count = spacing_.count;
    if (ui::number("layers/count", count, count_tip)) spacing_.count = std::clamp(count, 1, 500);
  }
  draw_first();
  layer_field("layers/ratio", "Ratio", spacing_.ratio, "Of the second height to the first.");
  layer_field("layers/growth", "Growth", spacing_.growth, "Of the ratio, from layer to layer.");
  draw_total();
}

void SpacingForm::draw_first() {
  if (!from_y_plus_)
    layer_field("layers/first", "First height", spacing_.first,
                "Height of the layer at the wall, in units of the mesh.");
  ui::checkbox(
      "layers/from_y_plus", "First height from y+", from_y_plus_,
      "Take the first height from a wanted y+, by the turbulent friction of a flat plate.");
  if (!from_y_plus_) return;
  layer_field("layers/y_plus", "y+", y_plus_, "Wanted y+ of the first node above the wall.");
  layer_field("layers/reynolds", "Reynolds", reynolds_, "Reynolds number of the reference length.");
  layer_field("layers/length", "Length", length_,
              "Reference length (chord), in units of the mesh.");
  try {
    spacing_.first = first_height_for_y_plus(y_plus_, reynolds_, length_);
    ui::text_dim("First height " + short_number(spacing_.first));
  } catch (const UsageError& error) {
    ui::text_colored(palette().warning, error.what());
  }
}

void SpacingForm::draw_total() {
  ui::checkbox("layers/has_total", "Total thickness", has_total_,
               "Give the thickness of all layers together; the ratio is then what gives it.");
  if (has_total_) {
    spacing_.match_outside = false;
    layer_field("layers/total", "Thickness", total_, "Of all layers, in units of the mesh.");
  }
  if (ui::checkbox("layers/match", "Match the elements outside", spacing_.match_outside,
                   "As many layers as it takes until the last is as high as the elements "
                   "outside; the ratio is adjusted for each column.") &&
      spacing_.match_outside)
    has_total_ = false;
}

LayerSpacing SpacingForm::spacing() const {
  LayerSpacing spacing = spacing_;
  if (has_total_) spacing.total = total_;
  return spacing;
}

void SpacingForm::set(const LayerSpacing& spacing) {
  spacing_ = spacing;
  spacing_.total.reset();
  has_total_ = spacing.total.has_value();
  total_ = spacing.total.value_or(total_);
  from_y_plus_ = false;
}

std::vector<double> SpacingForm::heights() const {
  try {
    return layer_heights(spacing());
  } catch (const Error&) {
    return {};  // incomplete input; the plan reports the error
  }
}

namespace {

std::string column_text(const LayerColumn& column) {
  return "n" + std::to_string(column.wall_node) + "  " + short_number(column.thickness()) + "  " +
         std::string(limit_name(column.limit));
}

/// The columns on the selected markers; all columns if these have none.
std::vector<const LayerColumn*> shown_columns(const Markers& markers,
                                              const std::vector<Index>& chosen,
                                              const LayerStack& stack) {
  std::vector<const LayerColumn*> all, selected;
  for (const LayerColumn& column : stack.columns) {
    all.push_back(&column);
    for (const Index marker : chosen)
      if (std::ranges::binary_search(markers.nodes(marker), column.wall_node)) {
        selected.push_back(&column);
        break;
      }
  }
  return selected.empty() ? all : selected;
}

/// Wanted and realised height of each layer, averaged over the columns that have it.
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
  heights_ = mean_heights(shown_columns(session.topology()->markers(), selection_, *stack_),
                          session.coordinates());
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
      context.emit(action::LookAt{place_of(context.session.coordinates(), column.wall_node),
                                  4 * std::max(column.asked, column.thickness())});
    ui::note(id);
    ui::tooltip("Show this column.");
  }
  ImGui::EndChild();
}

}  // namespace winslow::gui
