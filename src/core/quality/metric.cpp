#include "core/quality/metric.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "core/error.h"

namespace winslow {

namespace {

using Corners = std::span<const Corner>;

/// R/(2r) of half a square: the value that a quadrilateral's corners are measured against.
const double square_radius_ratio = (1 + std::sqrt(2.0)) / 2;

double smallest_sine(Corners corners) {
  double smallest = 1;
  for (const Corner& corner : corners) smallest = std::min(smallest, corner.sine());
  return smallest;
}

double aspect_ratio(Corners corners) {
  double largest = 0;
  for (const Corner& corner : corners) {
    const double ratio = corner.radius_ratio();
    largest = std::max(largest, corners.size() == 3 ? ratio : ratio / square_radius_ratio);
  }
  return largest;
}

double condition_number(Corners corners) {
  double largest = 0;
  for (const Corner& corner : corners) {
    largest = std::max(
        largest, corners.size() == 3 ? corner.triangle_condition() : corner.square_condition());
  }
  return largest;
}

double area(Corners corners) {
  if (corners.size() == 3) return 0.5 * corners[0].area2;
  double sum = 0;
  for (const Corner& corner : corners) sum += 0.25 * corner.area2;
  return sum;
}

/// In the order of the enumeration.
constexpr std::array metrics{
    MetricInfo{
        .field = {.name = "normalized_jacobian",
                  .label = "Normalized Jacobian",
                  .help = "Sine of every corner angle: 0.866 for an equilateral triangle, 1 for a "
                          "right angle, negative where an element is inverted. Larger is better.",
                  .larger_is_better = true,
                  .colors = ColorRange::zero_to_one,
                  .threshold = 0.5,
                  .has_sign = true},
        .of_element = smallest_sine,
        .reported = true,
        .of_corner = [](const Corner& corner) { return corner.sine(); }},
    MetricInfo{.field = {.name = "aspect_ratio",
                         .label = "Aspect ratio",
                         .help = "R/2r, circumradius over twice the inradius. 1 is best. Inverted "
                                 "elements are left out.",
                         .larger_is_better = false,
                         .colors = ColorRange::from_one,
                         .threshold = 1.5},
               .of_element = aspect_ratio,
               .reported = true},
    MetricInfo{.field = {.name = "condition_number",
                         .label = "Condition number",
                         .help = "Weighted condition number of the corners. 1 is best. Inverted "
                                 "elements are left out.",
                         .larger_is_better = false,
                         .colors = ColorRange::from_one,
                         .threshold = 1.5},
               .of_element = condition_number,
               .reported = true},
    MetricInfo{.field = {.name = "area",
                         .label = "Area",
                         .help = "Signed area, in squared units of the mesh.",
                         .larger_is_better = true,
                         .colors = ColorRange::robust_both_sides,
                         .threshold = 0,
                         .has_sign = true},
               .of_element = area},
};
static_assert(metrics.size() == static_cast<std::size_t>(Metric::area) + 1);

}  // namespace

const MetricInfo& metric_info(Metric metric) { return metrics[static_cast<std::size_t>(metric)]; }

const std::vector<Metric>& all_metrics() {
  static const std::vector<Metric> all = [] {
    std::vector<Metric> list;
    for (std::size_t i = 0; i < metrics.size(); ++i) list.push_back(static_cast<Metric>(i));
    return list;
  }();
  return all;
}

const std::vector<Metric>& reported_metrics() {
  static const std::vector<Metric> reported = [] {
    std::vector<Metric> list = all_metrics();
    std::erase_if(list, [](Metric metric) { return !metric_info(metric).reported; });
    return list;
  }();
  return reported;
}

std::string_view metric_name(Metric metric) { return metric_info(metric).field.name; }
std::string_view metric_label(Metric metric) { return metric_info(metric).field.label; }

Metric parse_metric(std::string_view name) {
  std::string known;
  for (const Metric metric : all_metrics()) {
    if (metric_name(metric) == name) return metric;
    known += (known.empty() ? "" : ", ") + std::string(metric_name(metric));
  }
  throw UsageError("unknown metric '" + std::string(name) + "', expected one of: " + known);
}

}  // namespace winslow
