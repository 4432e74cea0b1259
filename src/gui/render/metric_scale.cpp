#include "gui/render/metric_scale.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "gui/render/ticks.h"

namespace winslow::gui {
namespace {

std::vector<double> finite_values(std::span<const double> values) {
  std::vector<double> finite;
  finite.reserve(values.size());
  for (const double v : values) {
    if (std::isfinite(v)) finite.push_back(v);
  }
  return finite;
}

double percentile(std::vector<double>& values, double share) {
  if (values.empty()) return 0;
  const auto k = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + k, values.end());
  return values[static_cast<std::size_t>(k)];
}

/// Range and direction of a linear scale that nobody chose.
void set_linear(ColorScale& scale, ColorRange range, std::vector<double>& finite) {
  constexpr double robust = 0.995;
  const double high = percentile(finite, robust);
  switch (range) {
    case ColorRange::zero_to_one:
      break;
    case ColorRange::up_to_one:
      scale.low = std::min(0.0, percentile(finite, 1 - robust));
      break;
    case ColorRange::from_zero:
      scale.high = high > 0 ? round_up_nicely(high) : 1;
      scale.reversed = true;
      break;
    case ColorRange::from_one:
      scale.low = 1;
      scale.high = std::max(round_up_nicely(high), 1.5);
      scale.reversed = true;
      break;
    case ColorRange::robust_both_sides:
      scale.low = std::min(0.0, percentile(finite, 1 - robust));
      scale.high = high > scale.low ? round_up_nicely(high) : scale.low + 1;
      break;
    case ColorRange::around_one: {
      constexpr double least = 1.1;  // what is off by rounding alone is not to fill the map
      scale.low = finite.empty() ? 1 / least : std::min(percentile(finite, 1 - robust), 1 / least);
      scale.high = std::max(round_up_nicely(high), least);
      break;
    }
    case ColorRange::counts:
      scale.low = 1;
      scale.high = std::max(percentile(finite, 1), 2.0);
      break;
  }
}

std::vector<double> positive(const std::vector<double>& values) {
  std::vector<double> found;
  std::ranges::copy_if(values, std::back_inserter(found), [](double v) { return v > 0; });
  return found;
}

/// Most elements would have the colours of one end of the linear scale.
bool wants_ratios(const ElementField& field, std::vector<double>& above_zero) {
  constexpr double flat = 20;
  const ColorRange range = field_info(field).colors;
  // Angles are compared by their differences.
  if (field_info(field).unit == "degrees") return false;
  if (range != ColorRange::from_one && range != ColorRange::robust_both_sides) return false;
  const double low = range == ColorRange::from_one ? 1 : percentile(above_zero, 0.01);
  return low > 0 && percentile(above_zero, 0.99) > flat * low;
}

/// From the first to the last percentile of what is positive.
void set_by_ratio(ColorScale& scale, ColorRange range, std::vector<double>& above_zero) {
  const double low = range == ColorRange::from_one ? 1 : percentile(above_zero, 0.01);
  const double high = percentile(above_zero, 0.99);
  if (!(high > low)) return;
  scale.low = low;
  scale.high = range == ColorRange::from_one ? round_up_nicely(high) : high;
  scale.logarithmic = true;
}

/// The range that a user chose, if it is one.
void set_range(ColorScale& scale, const std::array<double, 2>& range) {
  if (!(range[1] > range[0])) return;
  scale.low = range[0];
  scale.high = range[1];
}

}  // namespace

std::vector<std::string> color_map_choices() {
  std::vector<std::string> names = color_map_names();
  names.insert(names.begin(), "automatic");
  return names;
}

std::string color_map_for(const ElementField& field, const std::string& choice) {
  if (choice != "automatic") return choice;
  if (field_info(field).one_is_best) return "puor";
  const bool quality = field.metric()
                           ? metric_info(*field.metric(), field.cell_dimension()).reported
                           : field != LayerField::layer && field != WallField::first_height;
  return quality ? "neutral" : "viridis";
}

ColorScale color_scale(const ElementField& field, std::span<const double> values,
                       const ColorChoice& choice) {
  const FieldInfo& info = field_info(field);
  ColorScale scale;
  scale.map = color_map_for(field, choice.map);
  scale.bands = choice.bands;
  scale.on_dark = choice.on_dark;
  if (info.has_sign) scale.centre = 0;
  if (info.one_is_best) scale.centre = 1;
  std::vector<double> finite = finite_values(values);
  set_linear(scale, info.colors, finite);
  std::vector<double> above_zero = positive(finite);
  const bool ratios = choice.axis == ColorAxis::automatic
                          ? !above_zero.empty() && wants_ratios(field, above_zero)
                          : choice.axis == ColorAxis::logarithmic;
  if (ratios) set_by_ratio(scale, info.colors, above_zero);
  if (choice.percentiles) {
    std::vector<double>& shown = ratios && !above_zero.empty() ? above_zero : finite;
    set_range(scale, {percentile(shown, (*choice.percentiles)[0] / 100),
                      percentile(shown, (*choice.percentiles)[1] / 100)});
  }
  if (choice.range) set_range(scale, *choice.range);
  scale.logarithmic = ratios && scale.low > 0;
  // Over decades there is structure to see at both ends, and nothing to recede.
  if (choice.map == "automatic" && scale.by_ratio()) scale.map = "viridis";
  return scale;
}

Histogram histogram_over(std::span<const double> values, const ColorScale& scale, int bins) {
  Histogram histogram{scale.low, scale.high, {}};
  histogram.counts.assign(static_cast<std::size_t>(std::max(bins, 1)), 0);
  const auto n = static_cast<double>(histogram.counts.size());
  for (const double v : values) {
    if (!std::isfinite(v)) continue;
    const double bin = std::clamp(std::floor(scale.share(v) * n), 0.0, n - 1);
    ++histogram.counts[static_cast<std::size_t>(bin)];
  }
  return histogram;
}

}  // namespace winslow::gui
