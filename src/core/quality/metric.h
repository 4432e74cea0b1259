#pragma once

#include <optional>

#include "core/quality/corner.h"
#include "core/quality/volume_element.h"

/// What there is to measure, by name:
///
///     const winslow::Metric metric = winslow::parse_metric("aspect_ratio");
///     std::puts(std::string(winslow::metric_info(metric).field.help).c_str());
///
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
///
/// Of volume elements (a corner is the tetrahedron of a corner and its three neighbours in the
/// element, E its edges there, W those of the regular element's corner; see corner_tetrahedra()):
/// - normalized_jacobian: smallest det E / (|e1| |e2| |e3|) of the corners over that of the regular
///   element's corner; of a tetrahedron all four corners count. (Verdict: scaled Jacobian.) 1 for
///   the regular element (more for a pyramid that is steeper), negative where a corner is inverted.
/// - aspect_ratio: R/(3r), circumradius over three times the inradius, of a tetrahedron (AIAA
///   2009-1362; Verdict: aspect ratio beta); of other elements the largest of the corners, over
///   that of the regular element's corner.
/// - condition_number: largest |J| |J^-1| / 3 of the corners, J = E W^-1, Frobenius norms (Verdict:
///   condition, for hexahedra; weighted to the regular element for all).
/// - smallest_solid_angle, largest_solid_angle: of the corners, in steradians, negative where
///   inverted (AIAA 2009-1362, section IV). 0.551 of the regular tetrahedron, pi/2 of a cube.
/// - volume: signed volume of the element, in cubed units of the file.
/// A volume element is inverted unless its Jacobian is positive all over it:
/// has_positive_jacobian().
enum class Metric {
  normalized_jacobian,
  aspect_ratio,
  condition_number,
  smallest_angle,
  largest_angle,
  skewness,
  area,
  smallest_solid_angle,
  largest_solid_angle,
  volume
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
  Metric metric;
  FieldInfo field;
  /// Of a plane element with these corners, in the order of its nodes.
  double (*of_element)(std::span<const Corner> corners) = nullptr;
  /// Of a volume element. One of the two is there.
  double (*of_volume)(const VolumeElement& element) = nullptr;
  /// In reports, with statistics, histograms and the worst elements.
  bool reported = false;
  double best = 1;  ///< end of the histogram
  /// Statistics run over this value of all corners of all elements; null: over the finite values of
  /// the elements.
  double (*of_corner)(const Corner& corner) = nullptr;
};

/// cell_dimension: 2 of plane meshes, 3 of volume meshes. Throws UsageError for a metric that
/// elements of that dimension do not have.
const MetricInfo& metric_info(Metric metric, int cell_dimension = 2);
/// All that elements of that dimension have, and those of them that are reported.
const std::vector<Metric>& all_metrics(int cell_dimension = 2);
const std::vector<Metric>& reported_metrics(int cell_dimension = 2);
std::string_view metric_name(Metric metric);   ///< "normalized_jacobian", as in files and options
std::string_view metric_label(Metric metric);  ///< "Normalized Jacobian", as on screen
/// By metric_name. Throws UsageError listing the names that elements of that dimension have.
Metric parse_metric(std::string_view name, int cell_dimension = 2);

}  // namespace winslow
