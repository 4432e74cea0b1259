#include "core/layers/layer_spacing.h"

#include "core/error.h"
#include "core/layers/layer_plan.h"

namespace winslow {

namespace {

/// Heights with every ratio multiplied by `scale`.
std::vector<double> heights(const LayerSpacing& spacing, double scale) {
  std::vector<double> all(static_cast<std::size_t>(spacing.count));
  double height = spacing.first;
  double ratio = spacing.ratio;
  for (double& h : all) {
    h = height;
    height *= ratio * scale;
    ratio *= spacing.growth;
  }
  return all;
}

/// The scale of the ratios for which measure(heights), which grows with the scale, is `wanted`. By
/// bisection.
template <typename Measure>
double scale_for(const LayerSpacing& spacing, double wanted, double low, const Measure& measure) {
  double high = std::max(2 * low, 1.0);
  while (measure(heights(spacing, high)) < wanted && high < 1e6) high *= 2;
  for (int i = 0; i < 200 && high - low > 1e-15 * high; ++i) {
    const double middle = 0.5 * (low + high);
    (measure(heights(spacing, middle)) < wanted ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

/// Smallest allowed scale of the ratios: it makes the smallest ratio 1, or keeps it if it is less.
double gentlest(const LayerSpacing& spacing) {
  const double last = spacing.ratio * std::pow(spacing.growth, std::max(spacing.count - 2, 0));
  return std::min(1.0, 1 / std::min(spacing.ratio, last));
}

void require(bool good, const std::string& what) {
  if (!good) throw UsageError(what);
}

}  // namespace

void validate(const LayerSpacing& s) {
  LayerSpacing copy = s;
  check(option_table(copy));
  require(!(s.total && s.match_outside),
          "a total thickness and a match of the last layer exclude each other");
}

std::vector<double> layer_heights(const LayerSpacing& spacing) {
  validate(spacing);
  if (!spacing.total) return heights(spacing, 1);
  const double least = sum_of(heights(spacing, gentlest(spacing)));
  if (spacing.count == 1) {
    LayerSpacing one = spacing;
    one.first = *spacing.total;
    return heights(one, 1);
  }
  require(*spacing.total >= least * (1 - 1e-12),
          std::to_string(spacing.count) + " layers, the first " + std::to_string(spacing.first) +
              " high, are at least " + std::to_string(least) + " thick; asked for " +
              std::to_string(*spacing.total));
  return heights(spacing, scale_for(spacing, *spacing.total, 0.5 * gentlest(spacing), sum_of));
}

std::vector<double> layer_heights_within(const LayerSpacing& spacing, double thickness) {
  LayerSpacing s = spacing;
  const double least = gentlest(s);
  while (s.count > 0 && sum_of(heights(s, least)) > thickness * (1 + 1e-12)) --s.count;
  if (s.count < 2 || s.count < spacing.count) return heights(s, least);
  return heights(s, scale_for(s, thickness, least, sum_of));
}

std::vector<double> layer_heights_ending_with(const LayerSpacing& spacing, double last) {
  if (spacing.count < 2) return heights(spacing, 1);
  const double least = gentlest(spacing);
  const auto back = [](const std::vector<double>& all) { return all.back(); };
  if (heights(spacing, least).back() > last) return heights(spacing, 1);
  return heights(spacing, scale_for(spacing, last, least, back));
}

int layers_until(const LayerSpacing& spacing, double last) {
  LayerSpacing s = spacing;
  s.count = most_layers;
  const std::vector<double> all = heights(s, 1);
  for (std::size_t k = 0; k < all.size(); ++k) {
    if (all[k] >= last) return static_cast<int>(k) + 1;
  }
  return most_layers;
}

double first_height_for_y_plus(double y_plus, double reynolds, double length) {
  require(y_plus > 0 && std::isfinite(y_plus), "y+ must be positive");
  require(reynolds > 0 && std::isfinite(reynolds), "the Reynolds number must be positive");
  require(length > 0 && std::isfinite(length), "the reference length must be positive");
  const double friction = 0.026 / std::pow(reynolds, 1.0 / 7);
  return y_plus * length / (reynolds * std::sqrt(friction / 2));
}

}  // namespace winslow
