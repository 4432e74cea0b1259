#include "core/quality/quantiles.h"

#include <algorithm>
#include <cmath>

namespace winslow {

namespace {

/// Reorders the values, of which there is at least one. Cheaper than to sort them all.
double quantile(std::vector<double>& values, double share) {
  const double place = share * static_cast<double>(values.size() - 1);
  const auto below = static_cast<std::ptrdiff_t>(std::floor(place));
  const auto at_place = values.begin() + below;
  std::nth_element(values.begin(), at_place, values.end());
  const double rest = place - static_cast<double>(below);
  if (rest == 0) return *at_place;
  return *at_place + rest * (*std::min_element(at_place + 1, values.end()) - *at_place);
}

}  // namespace

Quantiles quantiles_of(std::vector<double> values) {
  std::erase_if(values, [](double value) { return !std::isfinite(value); });
  Quantiles of;
  of.count = values.size();
  if (values.empty()) return of;
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  of.min = *least;
  of.max = *most;
  of.low = quantile(values, 0.05);
  of.median = quantile(values, 0.5);
  of.high = quantile(values, 0.95);
  return of;
}

}  // namespace winslow
