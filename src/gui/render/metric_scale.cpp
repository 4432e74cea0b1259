#include "gui/render/metric_scale.h"

#include <algorithm>
#include <cmath>

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

}  // namespace

ColorScale automatic_scale(const ElementField& field, std::span<const double> values,
                           const std::string& map) {
  constexpr double robust = 0.995;
  ColorScale scale;
  scale.map = map;
  if (field_info(field).has_sign) scale.centre = 0;
  std::vector<double> finite = finite_values(values);
  const double high = percentile(finite, robust);
  switch (field_info(field).colors) {
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
    case ColorRange::counts:
      scale.low = 1;
      scale.high = std::max(percentile(finite, 1), 2.0);
      break;
  }
  return scale;
}

Histogram histogram_over(std::span<const double> values, const ColorScale& scale, int bins) {
  Histogram histogram{scale.low, scale.high, {}};
  histogram.counts.assign(static_cast<std::size_t>(std::max(bins, 1)), 0);
  const auto n = static_cast<double>(histogram.counts.size());
  const double span = scale.high - scale.low;
  for (const double v : values) {
    if (!std::isfinite(v)) continue;
    const double t = span > 0 ? (v - scale.low) / span : 0.0;
    const double bin = std::clamp(std::floor(t * n), 0.0, n - 1);
    ++histogram.counts[static_cast<std::size_t>(bin)];
  }
  return histogram;
}

}  // namespace winslow::gui
