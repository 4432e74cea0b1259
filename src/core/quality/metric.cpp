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

double smallest_angle(Corners corners) {
  double smallest = 180;
  for (const Corner& corner : corners) smallest = std::min(smallest, corner.angle());
  return smallest;
}

double largest_angle(Corners corners) {
  double largest = 0;
  for (const Corner& corner : corners) {
    const double angle = corner.angle();
    largest = std::max(largest, angle < 0 ? angle + 360 : angle);
  }
  return largest;
}

double skewness(Corners corners) {
  const double ideal = corners.size() == 3 ? 60 : 90;
  const double wide = (largest_angle(corners) - ideal) / (180 - ideal);
  const double narrow = (ideal - smallest_angle(corners)) / ideal;
  return std::max({wide, narrow, 0.0});  // round-off of a perfect element is no skewness below 0
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
    MetricInfo{
        .field = {.name = "aspect_ratio",
                  .label = "Aspect ratio",
                  .help = "R/2r, circumradius over twice the inradius. 1 is best for a mesh "
                          "that is not stretched on purpose. Inverted elements are left out.",
                  .larger_is_better = false,
                  .colors = ColorRange::from_one,
                  .threshold = 1.5,
                  .judged = false},
        .of_element = aspect_ratio,
        .reported = true},
    MetricInfo{
        .field = {.name = "condition_number",
                  .label = "Condition number",
                  .help = "Weighted condition number of the corners. 1 is best for a mesh "
                          "that is not stretched on purpose. Inverted elements are left out.",
                  .larger_is_better = false,
                  .colors = ColorRange::from_one,
                  .threshold = 1.5,
                  .judged = false},
        .of_element = condition_number,
        .reported = true},
    MetricInfo{
        .field = {.name = "smallest_angle",
                  .label = "Smallest angle",
                  .help = "Smallest angle of an element's corners, in degrees, negative where "
                          "a corner is inverted. 60 is best of a triangle, 90 of a "
                          "quadrilateral.",
                  .larger_is_better = true,
                  .colors = ColorRange::robust_both_sides,
                  .threshold = 30,
                  .unit = "degrees"},
        .of_element = smallest_angle,
        .reported = true,
        .best = 90},
    MetricInfo{.field = {.name = "largest_angle",
                         .label = "Largest angle",
                         .help = "Largest angle of an element's corners, in degrees, more than 180 "
                                 "where a corner is inverted. 60 is best of a triangle, 90 of a "
                                 "quadrilateral.",
                         .larger_is_better = false,
                         .colors = ColorRange::from_zero,
                         .threshold = 120,
                         .unit = "degrees"},
               .of_element = largest_angle,
               .reported = true,
               .best = 60},
    MetricInfo{
        .field = {.name = "skewness",
                  .label = "Skewness",
                  .help = "Equiangle skewness: how far the worst angle is from 60 degrees (90 "
                          "of a quadrilateral), relative to the farthest it can be. 0 is "
                          "best, 1 degenerate, more is inverted.",
                  .larger_is_better = false,
                  .colors = ColorRange::from_zero,
                  .threshold = 0.5},
        .of_element = skewness,
        .reported = true,
        .best = 0},
    MetricInfo{.field = {.name = "area",
                         .label = "Area",
                         .help = "Signed area, in squared units of the mesh.",
                         .larger_is_better = true,
                         .colors = ColorRange::robust_both_sides,
                         .threshold = 0,
                         .has_sign = true,
                         .unit = "squared units of the mesh"},
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
