#include "core/quality/metric.h"

#include <algorithm>

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

/// Those of plane elements, in the order of the enumeration.
constexpr std::array plane_metrics{
    MetricInfo{
        .metric = Metric::normalized_jacobian,
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
        .metric = Metric::aspect_ratio,
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
        .metric = Metric::condition_number,
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
        .metric = Metric::smallest_angle,
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
    MetricInfo{.metric = Metric::largest_angle,
               .field = {.name = "largest_angle",
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
        .metric = Metric::skewness,
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
    MetricInfo{.metric = Metric::area,
               .field = {.name = "area",
                         .label = "Area",
                         .help = "Signed area, in squared units of the mesh.",
                         .larger_is_better = true,
                         .colors = ColorRange::robust_both_sides,
                         .threshold = 0,
                         .has_sign = true,
                         .unit = "squared units of the mesh"},
               .of_element = area},
};

/// Those of volume elements, in the order of the enumeration.
constexpr std::array volume_metrics{
    MetricInfo{.metric = Metric::normalized_jacobian,
               .field = {.name = "normalized_jacobian",
                         .label = "Scaled Jacobian",
                         .help = "Determinant of the edges at every corner over their lengths: 1 "
                                 "for the regular element, negative where an element is inverted. "
                                 "Larger is better.",
                         .larger_is_better = true,
                         .colors = ColorRange::zero_to_one,
                         .threshold = 0.2,
                         .has_sign = true},
               .of_volume = [](const VolumeElement& e) { return e.scaled_jacobian(); },
               .reported = true},
    MetricInfo{.metric = Metric::aspect_ratio,
               .field = {.name = "aspect_ratio",
                         .label = "Aspect ratio",
                         .help = "R/3r, circumradius over three times the inradius. 1 is best for "
                                 "a mesh that is not stretched on purpose. Inverted elements are "
                                 "left out.",
                         .larger_is_better = false,
                         .colors = ColorRange::from_one,
                         .threshold = 3,
                         .judged = false},
               .of_volume = [](const VolumeElement& e) { return e.radius_ratio(); },
               .reported = true},
    MetricInfo{
        .metric = Metric::condition_number,
        .field = {.name = "condition_number",
                  .label = "Condition number",
                  .help = "Weighted condition number of the corners. 1 is best for a mesh "
                          "that is not stretched on purpose. Inverted elements are left out.",
                  .larger_is_better = false,
                  .colors = ColorRange::from_one,
                  .threshold = 3,
                  .judged = false},
        .of_volume = [](const VolumeElement& e) { return e.condition_number(); },
        .reported = true},
    MetricInfo{.metric = Metric::smallest_solid_angle,
               .field = {.name = "smallest_solid_angle",
                         .label = "Smallest solid angle",
                         .help = "Smallest solid angle of an element's corners, in steradians, "
                                 "negative where a corner is inverted. 0.551 is best of a "
                                 "tetrahedron, 1.571 of a hexahedron.",
                         .larger_is_better = true,
                         .colors = ColorRange::robust_both_sides,
                         .threshold = 0.1,
                         .unit = "steradians"},
               .of_volume = [](const VolumeElement& e) { return e.smallest_solid_angle(); },
               .reported = true,
               .best = pi / 2},
    MetricInfo{.metric = Metric::largest_solid_angle,
               .field = {.name = "largest_solid_angle",
                         .label = "Largest solid angle",
                         .help = "Largest solid angle of an element's corners, in steradians. "
                                 "0.551 is best of a tetrahedron, 1.571 of a hexahedron.",
                         .larger_is_better = false,
                         .colors = ColorRange::from_zero,
                         .threshold = 2,
                         .unit = "steradians"},
               .of_volume = [](const VolumeElement& e) { return e.largest_solid_angle(); },
               .reported = true,
               .best = 0.5},
    MetricInfo{.metric = Metric::volume,
               .field = {.name = "volume",
                         .label = "Volume",
                         .help = "Signed volume, in cubed units of the mesh.",
                         .larger_is_better = true,
                         .colors = ColorRange::robust_both_sides,
                         .threshold = 0,
                         .has_sign = true,
                         .unit = "cubed units of the mesh"},
               .of_volume = [](const VolumeElement& e) { return e.volume(); }},
};

std::span<const MetricInfo> table(int cell_dimension) {
  if (cell_dimension == 2) return plane_metrics;
  return volume_metrics;
}

/// The same of any dimension: for names.
const MetricInfo& any_info(Metric metric) {
  for (const int dimension : {2, 3}) {
    for (const MetricInfo& info : table(dimension)) {
      if (info.metric == metric) return info;
    }
  }
  throw UsageError("a metric that no element has");
}

std::vector<Metric> metrics_of(int cell_dimension, bool reported_only) {
  std::vector<Metric> list;
  for (const MetricInfo& info : table(cell_dimension)) {
    if (info.reported || !reported_only) list.push_back(info.metric);
  }
  return list;
}

}  // namespace

const MetricInfo& metric_info(Metric metric, int cell_dimension) {
  for (const MetricInfo& info : table(cell_dimension)) {
    if (info.metric == metric) return info;
  }
  throw UsageError(std::string(cell_dimension == 2 ? "plane" : "volume") +
                   " elements have no metric '" + std::string(metric_name(metric)) + "'");
}

const std::vector<Metric>& all_metrics(int cell_dimension) {
  static const std::array lists{metrics_of(2, false), metrics_of(3, false)};
  return lists[cell_dimension == 2 ? 0 : 1];
}

const std::vector<Metric>& reported_metrics(int cell_dimension) {
  static const std::array lists{metrics_of(2, true), metrics_of(3, true)};
  return lists[cell_dimension == 2 ? 0 : 1];
}

std::string_view metric_name(Metric metric) { return any_info(metric).field.name; }
std::string_view metric_label(Metric metric) { return any_info(metric).field.label; }

Metric parse_metric(std::string_view name, int cell_dimension) {
  std::string known;
  for (const Metric metric : all_metrics(cell_dimension)) {
    if (metric_name(metric) == name) return metric;
    known += (known.empty() ? "" : ", ") + std::string(metric_name(metric));
  }
  throw UsageError("unknown metric '" + std::string(name) + "', expected one of: " + known);
}

}  // namespace winslow
