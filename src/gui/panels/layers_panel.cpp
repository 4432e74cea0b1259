#include "gui/panels/layers_panel.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/error.h"
#include "core/layers/layer_measures.h"
#include "gui/studio/text.h"
#include "gui/widgets/controls.h"
#include "gui/widgets/height_plot.h"

namespace winslow::gui {

namespace {

constexpr float label_share = 0.46f;

void field(const char* id, const char* label, double& value, const char* tip) {
  ui::row(label, tip, label_share);
  double typed = value;
  if (ui::number(id, typed, tip) && std::isfinite(typed)) value = typed;
}

std::string marker_list(const std::vector<std::string>& names) {
  std::string text;
  for (const auto& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

std::string column_text(const LayerColumn& column) {
  return "n" + std::to_string(column.wall_node) + "  " + short_number(column.thickness()) + "  " +
         std::string(limit_name(column.limit));
}

/// Height of each layer as it came out, on average over the columns that have it.
std::vector<double> realised_heights(const LayerStack& stack, const Coordinates& x) {
  std::vector<double> sum, count;
  for (const LayerColumn& column : stack.columns) {
    if (sum.size() < column.count()) {
      sum.resize(column.count());
      count.resize(column.count());
    }
    for (std::size_t k = 0; k + 1 < column.nodes.size(); ++k) {
      sum[k] += (x.xy(column.nodes[k + 1]) - x.xy(column.nodes[k])).norm() / column.slant;
      count[k] += 1;
    }
  }
  for (std::size_t k = 0; k < sum.size(); ++k) sum[k] /= std::max(count[k], 1.0);
  return sum;
}

}  // namespace

void LayersPanel::draw(const PanelContext& context) {
  const auto hide = [&] {
    if (context.session.layer_preview().wanted()) context.emit(action::PreviewLayers{});
  };
  if (!ui::section("section/layers", "Layers")) return hide();
  if (!context.session.document()) {
    ui::text_dim("No mesh is open.");
    return;
  }
  if (context.session.layers()) draw_result(context);
  if (context.session.selection().empty()) {
    ui::text_wrapped("Select the markers that are walls first.");
    return hide();
  }
  ImGui::BeginDisabled(context.session.in_motion());
  draw_spacing();
  draw_corners();
  draw_insertion(context);
  ImGui::EndDisabled();
}

void LayersPanel::draw_spacing() {
  constexpr const char* count_tip = "Number of layers.";
  if (!spacing_.match_outside) {
    ui::row("Layers", count_tip, label_share);
    int count = spacing_.count;
    if (ui::number("layers/count", count, count_tip)) spacing_.count = std::clamp(count, 1, 500);
  }
  draw_y_plus();
  field("layers/ratio", "Ratio", spacing_.ratio, "Of the second height to the first.");
  field("layers/growth", "Growth", spacing_.growth, "Of the ratio, from layer to layer.");
  ui::checkbox("layers/has_total", "Total thickness", has_total_,
               "Give the thickness of all layers together; the ratio is then what gives it.");
  if (has_total_) {
    spacing_.match_outside = false;
    field("layers/total", "Thickness", total_, "Of all layers, in units of the mesh.");
  }
  if (ui::checkbox("layers/match", "Match the elements outside", spacing_.match_outside,
                   "As many layers as it takes until the last is as high as the elements "
                   "outside; the ratio is adjusted for each column.") &&
      spacing_.match_outside)
    has_total_ = false;
}

void LayersPanel::draw_y_plus() {
  if (!from_y_plus_)
    field("layers/first", "First height", spacing_.first,
          "Height of the layer at the wall, in units of the mesh.");
  ui::checkbox(
      "layers/from_y_plus", "First height from y+", from_y_plus_,
      "Take the first height from a wanted y+, by the turbulent friction of a flat plate.");
  if (!from_y_plus_) return;
  field("layers/y_plus", "y+", y_plus_, "Wanted y+ of the first node above the wall.");
  field("layers/reynolds", "Reynolds", reynolds_, "Reynolds number of the reference length.");
  field("layers/length", "Length", length_, "Reference length (chord), in units of the mesh.");
  try {
    spacing_.first = first_height_for_y_plus(y_plus_, reynolds_, length_);
    ui::text_dim("First height " + short_number(spacing_.first));
  } catch (const UsageError& error) {
    ui::text_colored(palette().warning, error.what());
  }
}

void LayersPanel::draw_corners() {
  if (!ui::fold("layers/corners", "Corners and gaps",
                "How layers go round corners and through gaps. The defaults need no touch."))
    return;
  ui::checkbox("layers/fans", "Fans at sharp corners", corners_.fans,
               "Several columns at sharp convex corners, such as a trailing edge.");
  if (corners_.fans) {
    field("layers/fan_threshold", "Fans from", corners_.fan_threshold,
          "Turning of the wall from which a corner gets a fan, degrees.");
    field("layers/fan_angle", "Fan angle", corners_.fan_angle,
          "Between neighbouring columns of a fan, degrees.");
  }
  field("layers/clearance", "Clearance", corners_.clearance,
        "Share of a gap's width that the layers of either side may take, below 0.5.");
  field("layers/steepest", "Steepest", corners_.steepest,
        "Change of thickness along the wall, per length of wall.");
}

LayerOptions LayersPanel::options(const PanelContext& context) const {
  LayerOptions all = corners_;
  LayerWall wall;
  for (const Index m : context.session.selection())
    wall.markers.push_back(context.topology()->markers()[static_cast<std::size_t>(m)].name);
  wall.spacing = spacing_;
  if (has_total_) wall.spacing.total = total_;
  all.walls = {wall};
  return all;
}

std::vector<double> LayersPanel::wanted_heights() const {
  LayerSpacing spacing = spacing_;
  if (has_total_) spacing.total = total_;
  try {
    return layer_heights(spacing);
  } catch (const Error&) {
    return {};  // numbers half typed; the plan says what is wrong
  }
}

void LayersPanel::draw_insertion(const PanelContext& context) {
  const LayerOptions wanted = options(context);
  ui::checkbox("layers/control", "Hold the spacing", control_,
               "Ask for the heights through the virtual control volumes, now and whenever a body "
               "moves. Off: smoothing spreads the layers as it likes.");
  ui::checkbox("layers/preview", "Show where they will stand", preview_,
               "Draw the planned columns and layers; columns cut short in another colour.");
  const bool shown = preview_ && !context.session.in_motion();
  const auto& planned = context.session.layer_preview().wanted();
  if (shown && planned != wanted) context.emit(action::PreviewLayers{wanted});
  if (!shown && planned) context.emit(action::PreviewLayers{});
  if (shown) draw_plan(context);
  const bool ready =
      !context.session.in_motion() && context.session.layer_preview().error().empty();
  if (ui::button("layers/insert", "Insert layers",
                 {"Insert layers at " + marker_list(wanted.walls.front().markers) +
                      ", make room for them and smooth.",
                  ui::ButtonStyle::primary, ready, -1})) {
    LayersCommand command;
    command.layers = wanted;
    command.control = control_;
    command.smooth = context.session.smooth_options();
    context.emit(action::RunCommand{command, false});
  }
  ui::height_plot("layers/plot", {wanted_heights(), {}}, context.theme);
}

void LayersPanel::draw_plan(const PanelContext& context) {
  const LayerPreview& preview = context.session.layer_preview();
  if (const std::string error = preview.error(); !error.empty())
    return ui::text_wrapped("Cannot be done: " + error);
  const LayerStack* plan = preview.plan();
  if (!plan) return ui::text_dim("Planning ...");
  double thickest = 0;
  std::size_t cut = 0;
  for (const LayerColumn& column : plan->columns) {
    thickest = std::max(thickest, column.thickness());
    cut += cut_short(column) ? 1 : 0;
  }
  ui::text_wrapped(counted(plan->columns.size(), "column") + ", " + std::to_string(cut) +
                   " cut short, up to " + short_number(thickest) + " thick");
  ui::note("layers/summary");
}

void LayersPanel::draw_result(const PanelContext& context) {
  const LayerStack& stack = *context.session.layers();
  const Coordinates& x = context.session.coordinates();
  const LayerMeasures measures = measure_layers(stack, x);
  ui::text_wrapped("This mesh has layers: " + counted(stack.columns.size(), "column") + ", " +
                   std::to_string(measures.cut_short) + " cut short, " +
                   short_number(measures.thickness.min) + " to " +
                   short_number(measures.thickness.max) + " thick; heights within " +
                   short_number(std::round(1e4 * measures.spacing_error.max) / 100) +
                   " % of those wanted" + (stack.held ? ", and held." : "."));
  ui::note("layers/result");
  const LayerColumn& tallest =
      *std::ranges::max_element(stack.columns, {}, [](const LayerColumn& c) { return c.count(); });
  ui::height_plot("layers/realised", {tallest.heights, realised_heights(stack, x)}, context.theme);
  if (measures.cut_short > 0) draw_cut_columns(context, stack);
}

void LayersPanel::draw_cut_columns(const PanelContext& context, const LayerStack& stack) {
  if (!ui::fold("layers/cut", "Columns cut short",
                "Columns thinner than asked, and why: wall node, thickness, reason."))
    return;
  constexpr std::size_t most = 200;
  const float line = ImGui::GetTextLineHeightWithSpacing();
  ImGui::BeginChild("cut", ImVec2(0, 6 * line), true);
  std::size_t number = 0;
  for (const LayerColumn& column : stack.columns) {
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
