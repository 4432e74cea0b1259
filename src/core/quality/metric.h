#pragma once

#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "core/quality/corner.h"

/// What can be measured of elements, as a table: reports, tables, lists of the worst elements,
/// colours, isolated elements and the reference page are read off it. TO ADD A METRIC, add an
/// enumerator and a row in metric.cpp.
namespace winslow {

/// Element metrics. Definitions (a corner is the triangle of a corner and its two neighbours in the
/// element: the element itself for a triangle; l1, l2, l3 its edges, A its signed area):
/// - normalized_jacobian: sine of the corner angle, negative where the corner is inverted; of an
///   element, that of its smallest corner. This is what AIAA 2009-1362 tabulates: 0.866 for an
///   equilateral corner, 1 for a right angle. (Verdict scales it by 2/sqrt(3) for triangles.)
/// - aspect_ratio: R/(2r), circumradius over twice the inradius, of the triangle (Verdict: radius
///   ratio); of a quadrilateral the largest over its four corners, divided by the value
///   (1+sqrt(2))/2 of a square's corner. 1 is best.
/// - condition_number: (l1^2+l2^2+l3^2)/(4 sqrt(3) A) of a triangle, weighted to the equilateral;
///   of a quadrilateral the largest (l1^2+l2^2)/(4A) over its corners, as in Verdict. 1 is best.
/// - smallest_angle, largest_angle: of the corners, in degrees. An inverted corner of angle -a
/// counts
///   as -a in the smallest and as the reflex angle 360 - a in the largest, so that neither hides
///   it. (Verdict, C. J. Stimpson et al., SAND2007-1751: minimum and maximum included angle.)
/// - skewness: with these two, max((largest - ideal) / (180 - ideal), (ideal - smallest) / ideal),
///   ideal = 60 of a triangle, 90 of a quadrilateral. 0 is best, 1 degenerate, more than 1
///   inverted. (ANSYS Fluent User's Guide, "normalized equiangular skewness"; VTK: equiangle skew.)
/// - area: signed area of the element, in squared units of the file.
/// An element is inverted if any of its corners has an area that is not positive. Aspect ratio and
/// condition number of an inverted element are infinite; statistics leave them out.
enum class Metric {
  normalized_jacobian,
  aspect_ratio,
  condition_number,
  smallest_angle,
  largest_angle,
  skewness,
  area
};

/// Between which values a field is shown in colours. The "robust" largest value leaves out the
/// worst half percent, so that a single sliver does not wash out the rest.
enum class ColorRange {
  zero_to_one,
  up_to_one,          ///< from the robust smallest value, at most 0, to 1
  from_zero,          ///< to the robust largest value
  from_one,           ///< to the robust largest value, at least 1.5
  around_one,         ///< from the robust smallest value to the robust largest, 1 well inside
  robust_both_sides,  ///< from the robust smallest value, at most 0, to the robust largest one
  counts              ///< from 1 to the largest value, at least 2
};

/// What there is to know of a number that each element has.
struct FieldInfo {
  std::string_view name;   ///< in files and options: "normalized_jacobian"
  std::string_view label;  ///< on screen: "Normalized Jacobian"
  std::string_view help;   ///< what it is, in whole sentences
  bool larger_is_better;
  ColorRange colors;
  double threshold;       ///< beyond which elements are isolated unless the user says otherwise
  bool has_sign = false;  ///< diverging colours have their middle at zero
  /// Of a ratio: 1 is best, whichever way it is off; diverging colours have their middle there.
  bool one_is_best = false;
  /// A change is shown as better or worse. Not of measures of stretching: the cells at a wall are
  /// stretched on purpose, and a mesh that has lost that is not better.
  bool judged = true;
  std::string_view unit = {};  ///< "degrees"; empty: a pure number
};

struct MetricInfo {
  FieldInfo field;
  /// Of an element with these corners, in the order of its nodes.
  double (*of_element)(std::span<const Corner> corners);
  /// In reports, with statistics, histograms and the worst elements.
  bool reported = false;
  double best = 1;  ///< end of the histogram
  /// Statistics run over this value of all corners of all elements; null: over the finite values of
  /// the elements.
  double (*of_corner)(const Corner& corner) = nullptr;
};

const MetricInfo& metric_info(Metric metric);
/// All of them, and those that are reported.
const std::vector<Metric>& all_metrics();
const std::vector<Metric>& reported_metrics();

std::string_view metric_name(Metric metric);   ///< "normalized_jacobian", as in files and options
std::string_view metric_label(Metric metric);  ///< "Normalized Jacobian", as on screen
/// By metric_name. Throws UsageError listing the names.
Metric parse_metric(std::string_view name);

}  // namespace winslow
