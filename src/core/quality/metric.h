#pragma once

#include "core/quality/finite_volumes.h"
#include "core/quality/volume_element.h"

/// The metrics by their names:
///
///     const winslow::Metric metric = winslow::parse_metric("aspect_ratio");
///     std::puts(std::string(winslow::metric_info(metric).field.help).c_str());
///
/// All metrics of elements, as a table. Reports, lists of the worst elements, colours, isolated
/// elements and the reference page read it. TO ADD A METRIC, add an enumerator and a row in
/// metric.cpp.
namespace winslow {

/// Whether an element of a surface mesh is turned over: its area vector and its reference normal
/// include more than 120 degrees. On a finely meshed surface the angle is near 0 or near 180
/// degrees. The limit is above 90 degrees since at a sharp tip a valid element may be perpendicular
/// to the mean of the normals at its nodes.
inline bool is_turned_over(const Vec3& area, const Vec3& normal) {
  constexpr double farthest = -0.5;  // cosine
  return area.dot(normal) < farthest * area.norm();
}

/// A corner of an element: the triangle of the corner and its two neighbours in the element.
struct Corner {
  double l1 = 0, l2 = 0, l3 = 0;  ///< edges at the corner (next, previous), and the one across
  double area2 = 0;               ///< twice the signed area
  double dot = 0;                 ///< scalar product of the two edges at the corner

  Corner() = default;
  Corner(const Vec2& p, const Vec2& next, const Vec2& previous) {
    const Vec2 a = next - p, b = previous - p;
    set_lengths(a, b, next, previous);
    area2 = cross(a, b);
  }

  /// A corner of an element of a surface mesh, in its own plane. normal: the reference normal; the
  /// area is negative if the corner is turned over.
  Corner(const Vec3& p, const Vec3& next, const Vec3& previous, const Vec3& normal) {
    const Vec3 a = next - p, b = previous - p;
    set_lengths(a, b, next, previous);
    const Vec3 area = a.cross(b);
    area2 = is_turned_over(area, normal) ? -area.norm() : area.norm();
  }

  bool inverted() const { return !(area2 > 0); }
  double sine() const { return l1 > 0 && l2 > 0 ? area2 / (l1 * l2) : 0; }
  /// Angle from the next edge counter-clockwise to the previous one, degrees in (-180, 180]:
  /// negative if the corner is inverted.
  double angle() const { return degrees(std::atan2(area2, dot)); }
  /// R/(2r): 1 for the equilateral triangle.
  double radius_ratio() const {
    return inverted() ? std::numeric_limits<double>::infinity()
                      : l1 * l2 * l3 * (l1 + l2 + l3) / (4 * area2 * area2);
  }
  /// Condition weighted to the equilateral triangle.
  double triangle_condition() const {
    return inverted() ? std::numeric_limits<double>::infinity()
                      : (l1 * l1 + l2 * l2 + l3 * l3) / (2 * std::sqrt(3.0) * area2);
  }
  /// Condition relative to a corner with this angle between edges of the same length.
  double condition(double angle) const {
    if (inverted()) return std::numeric_limits<double>::infinity();
    return (l1 * l1 + l2 * l2 - 2 * std::cos(angle) * dot) / (2 * std::sin(angle) * area2);
  }
  /// The same corner with its edges lengthened.
  Corner stretched(double next, double previous) const {
    Corner out = *this;
    out.l1 *= next;
    out.l2 *= previous;
    out.dot *= next * previous;
    out.area2 *= next * previous;
    out.l3 = std::sqrt(std::max(0.0, out.l1 * out.l1 + out.l2 * out.l2 - 2 * out.dot));
    return out;
  }
  /// Condition relative to a square's corner.
  double square_condition() const {
    return inverted() ? std::numeric_limits<double>::infinity() : (l1 * l1 + l2 * l2) / (2 * area2);
  }

 private:
  template <class Point>
  void set_lengths(const Point& a, const Point& b, const Point& next, const Point& previous) {
    l1 = a.norm();
    l2 = b.norm();
    l3 = (next - previous).norm();
    dot = a.dot(b);
  }
};

inline Corner corner_of(const Coordinates& x, std::span<const Index> element, std::size_t k) {
  const std::size_t n = element.size();
  return {x.xy(element[k]), x.xy(element[(k + 1) % n]), x.xy(element[(k + n - 1) % n])};
}

/// The same for a surface mesh.
inline Corner corner_of(const Points<3>& x, std::span<const Index> element, std::size_t k,
                        const Vec3& normal) {
  const std::size_t n = element.size();
  return {x[element[k]], x[element[(k + 1) % n]], x[element[(k + n - 1) % n]], normal};
}

/// What the metrics of plane elements see: the corners of an element in the order of its nodes, of
/// a polygon those that are not flat. The edges of these are as long as the sides would be if the
/// flat corners lay evenly along them, so that a quadrilateral has the same values with flat
/// corners and without.
struct PlaneElement {
  std::span<const Corner> corners;
  double polygon_area = 0;  ///< of polygons: the signed area
  bool polygon = false;

  /// Of the regular element.
  double sides() const { return std::max(3.0, static_cast<double>(corners.size())); }
};

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
/// - smallest_angle, largest_angle: of the corners, in degrees. The angle of an inverted corner is
///   negative, -a, in the smallest angle and the reflex angle 360 - a in the largest. (Verdict, C.
///   J. Stimpson et al., SAND2007-1751: minimum and maximum included angle.)
/// - skewness: with these two, max((largest - ideal) / (180 - ideal), (ideal - smallest) / ideal),
///   ideal = 60 of a triangle, 90 of a quadrilateral. 0 is best, 1 degenerate, more than 1
///   inverted. (ANSYS Fluent User's Guide, "normalized equiangular skewness"; VTK: equiangle skew.)
/// - area: signed area of the element, in squared units of the file.
/// A polygon has the values of its corners that are not flat (corners_of_polygon()), relative to
/// those of the regular polygon with as many: for n of them, angles of (1 - 2/n) 180 degrees.
/// An element is inverted if any of its corners has an area that is not positive; a polygon also if
/// its own area is not positive or edges of it cross. Aspect ratio and condition number of an
/// inverted element are infinite; statistics leave them out.
///
/// For volume elements (a corner is the tetrahedron of a corner and its three neighbours in the
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
/// And those of OpenFOAM, which depend on the neighbours, too (FiniteVolumes has the formulas):
/// - non_orthogonality: largest angle between the area vector of a face and the line between the
///   centres of its two cells, in degrees. 0 is best.
/// - skewness: largest distance of a face's centre from that line, over the size of the face. 0 is
///   best.
/// - cell_aspect_ratio: of the areas of the faces, projected along x, y and z. 1 is best.
/// - determinant: of the area vectors of the internal faces. 1 for a cube inside a mesh.
/// - volume_ratio: smallest ratio of the volumes of the element and a neighbour. 1 is best.
/// - face_pyramid: smallest volume of a face's pyramid over the mean of the element. 1 is best,
///   negative where a face is seen from its wrong side.
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
  volume,
  non_orthogonality,
  cell_aspect_ratio,
  determinant,
  volume_ratio,
  face_pyramid
};

/// The range of values that the colours of a field cover. The robust largest value leaves out the
/// worst half percent, so that a single sliver does not determine the range.
enum class ColorRange {
  zero_to_one,
  up_to_one,          ///< from the robust smallest value, at most 0, to 1
  from_zero,          ///< to the robust largest value
  from_one,           ///< to the robust largest value, at least 1.5
  around_one,         ///< from the robust smallest value to the robust largest, 1 well inside
  robust_both_sides,  ///< from the robust smallest value, at most 0, to the robust largest one
  counts              ///< from 1 to the largest value, at least 2
};

enum class Better { larger, smaller };

/// Properties that few fields have.
struct FieldTraits {
  bool has_sign = false;       ///< diverging colours have their middle at zero
  bool one_is_best = false;    ///< a ratio; diverging colours have their middle at 1
  bool judged = true;          ///< false for measures of stretching, which is wanted at walls: a
                               ///< change is neither better nor worse
  std::string_view unit = {};  ///< "degrees"; empty: a pure number
};

/// Name and properties of a field, which has a number for each element.
struct FieldInfo : FieldTraits {
  constexpr FieldInfo(std::string_view n, std::string_view l, std::string_view h, Better better,
                      ColorRange c, double t, FieldTraits traits = {})
      : FieldTraits(traits),
        name(n),
        label(l),
        help(h),
        larger_is_better(better == Better::larger),
        colors(c),
        threshold(t) {}

  std::string_view name;   ///< in files and options: "normalized_jacobian"
  std::string_view label;  ///< on screen: "Normalized Jacobian"
  std::string_view help;   ///< what it is, in whole sentences
  bool larger_is_better;
  ColorRange colors;
  double threshold;  ///< default limit for isolating elements
};

/// A metric of plane elements or of volume elements.
struct MetricInfo {
  using OfElement = double (*)(const PlaneElement& element);
  using OfVolume = double (VolumeElement::*)() const;
  using OfCell = double (FiniteVolumes::*)(Index cell) const;
  using OfCorner = double (Corner::*)() const;

  /// best: end of the histogram; if it is given, the metric is reported.
  constexpr MetricInfo(Metric m, const FieldInfo& f, OfElement of, std::optional<double> b = {},
                       OfCorner corner = nullptr)
      : metric(m),
        field(f),
        of_element(of),
        of_corner(corner),
        reported(b.has_value()),
        best(b.value_or(1)) {}
  constexpr MetricInfo(Metric m, const FieldInfo& f, OfVolume of, std::optional<double> b = {})
      : metric(m), field(f), of_volume(of), reported(b.has_value()), best(b.value_or(1)) {}
  constexpr MetricInfo(Metric m, const FieldInfo& f, OfCell of, double b)
      : metric(m), field(f), of_cell(of), reported(false), best(b) {}

  Metric metric;
  FieldInfo field;
  OfElement of_element = nullptr;
  OfVolume of_volume = nullptr;
  OfCell of_cell = nullptr;  ///< depends on neighbours, too; a metric has one of the three
  /// Statistics use this value of all corners of all elements; null: they use the finite values of
  /// the elements.
  OfCorner of_corner = nullptr;
  /// In reports, with statistics, histograms and the worst elements. Those of cells are not: they
  /// take as long as all others together, and OpenFoamMeasures reports them.
  bool reported;
  double best;  ///< end of the histogram
  /// Whether it rates an element, so that it can have a limit.
  bool rates() const { return reported || of_cell != nullptr; }

  double of(const PlaneElement& element) const { return of_element(element); }
  double of(const VolumeElement& element) const { return (element.*of_volume)(); }
};

/// cell_dimension: 2 of plane meshes, 3 of volume meshes. Throws UsageError for a metric that
/// elements of that dimension do not have.
const MetricInfo& metric_info(Metric metric, int cell_dimension = 2);
/// All metrics of elements of that dimension, those of them that are reported, and those that rate
/// elements (MetricInfo::rates()), the reported ones first.
const std::vector<Metric>& all_metrics(int cell_dimension = 2);
const std::vector<Metric>& reported_metrics(int cell_dimension = 2);
const std::vector<Metric>& rating_metrics(int cell_dimension = 2);
std::string_view metric_name(Metric metric);   ///< "normalized_jacobian", as in files and options
std::string_view metric_label(Metric metric);  ///< "Normalized Jacobian", as on screen
/// The metric with a metric_name(). Throws UsageError listing the names of metrics of that
/// dimension.
Metric parse_metric(std::string_view name, int cell_dimension = 2);

}  // namespace winslow
