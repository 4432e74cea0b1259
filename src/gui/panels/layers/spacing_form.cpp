#include "gui/panels/layers/spacing_form.h"

#include <algorithm>

#include "core/error.h"
#include "gui/base/text.h"
#include "gui/panels/layers/fields.h"

namespace winslow::gui {

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
    return {};  // numbers half typed; the plan says what is wrong
  }
}

}  // namespace winslow::gui
