#include "core/quality/metric.h"

#include "core/error.h"

namespace winslow {

namespace {

/// R/(2r) of half a square, by which values of corners of quadrilaterals are divided.
const double square_radius_ratio = (1 + std::sqrt(2.0)) / 2;

double ideal_angle(const PlaneElement& element) {
  return element.polygon ? 180 * (1 - 2 / element.sides()) : element.corners.size() == 3 ? 60 : 90;
}

/// R/(2r) of a corner of the regular element.
double regular_radius_ratio(const PlaneElement& element) {
  if (element.corners.size() == 3) return 1;
  if (!element.polygon) return square_radius_ratio;
  const double angle = radians(ideal_angle(element)), sine = std::sin(angle);
  const double across = 2 * std::sin(angle / 2);
  return across * (2 + across) / (4 * sine * sine);
}

double smallest_sine(const PlaneElement& element) {
  double smallest = 1;
  for (const Corner& corner : element.corners) smallest = std::min(smallest, corner.sine());
  return smallest;
}

constexpr const char* condition_help =
    "Weighted condition number of the corners. 1 is best for a mesh that is not stretched on "
    "purpose. Inverted elements are left out.";

double aspect_ratio(const PlaneElement& element) {
  const double regular = regular_radius_ratio(element);
  double largest = 0;
  for (const Corner& corner : element.corners)
    largest = std::max(largest, corner.radius_ratio() / regular);
  return largest;
}

double condition_number(const PlaneElement& element) {
  const std::size_t n = element.corners.size();
  const double angle = radians(ideal_angle(element));
  double largest = 0;
  for (const Corner& corner : element.corners) {
    const double condition = element.polygon ? corner.condition(angle)
                             : n == 3        ? corner.triangle_condition()
                                             : corner.square_condition();
    largest = std::max(largest, condition);
  }
  return largest;
}

double smallest_angle(const PlaneElement& element) {
  double smallest = 180;
  for (const Corner& corner : element.corners) smallest = std::min(smallest, corner.angle());
  return smallest;
}

double largest_angle(const PlaneElement& element) {
  double largest = 0;
  for (const Corner& corner : element.corners) {
    const double angle = corner.angle();
    largest = std::max(largest, angle < 0 ? angle + 360 : angle);
  }
  return largest;
}

double skewness(const PlaneElement& element) {
  const double ideal = ideal_angle(element);
  const double wide = (largest_angle(element) - ideal) / (180 - ideal);
  const double narrow = (ideal - smallest_angle(element)) / ideal;
  return std::max({wide, narrow, 0.0});  // round-off of a perfect element could be negative
}

double area(const PlaneElement& element) {
  if (element.polygon) return element.polygon_area;
  if (element.corners.size() == 3) return 0.5 * element.corners[0].area2;
  double sum = 0;
  for (const Corner& corner : element.corners) sum += 0.25 * corner.area2;
  return sum;
}

/// In the order of the enumeration.
constexpr std::array plane_metrics{
    MetricInfo(
        Metric::normalized_jacobian,
        FieldInfo(
            "normalized_jacobian", "Normalized Jacobian",
            "Sine of every corner angle: 0.866 for an equilateral triangle, 1 for a right angle, "
            "negative where an element is inverted. Larger is better.",
            Better::larger, ColorRange::zero_to_one, 0.5, {.has_sign = true}),
        smallest_sine, 1, &Corner::sine),
    MetricInfo(
        Metric::aspect_ratio,
        FieldInfo("aspect_ratio", "Aspect ratio",
                  "R/2r, circumradius over twice the inradius. 1 is best for a mesh that is not "
                  "stretched on purpose. Inverted elements are left out.",
                  Better::smaller, ColorRange::from_one, 1.5, {.judged = false}),
        aspect_ratio, 1),
    MetricInfo(Metric::condition_number,
               FieldInfo("condition_number", "Condition number", condition_help, Better::smaller,
                         ColorRange::from_one, 1.5, {.judged = false}),
               condition_number, 1),
    MetricInfo(
        Metric::smallest_angle,
        FieldInfo("smallest_angle", "Smallest angle",
                  "Smallest angle of an element's corners, in degrees, negative where a corner is "
                  "inverted. 60 is best of a triangle, 90 of a quadrilateral, more of a polygon.",
                  Better::larger, ColorRange::robust_both_sides, 30, {.unit = "degrees"}),
        smallest_angle, 90),
    MetricInfo(
        Metric::largest_angle,
        FieldInfo(
            "largest_angle", "Largest angle",
            "Largest angle of an element's corners, in degrees, more than 180 where a corner is "
            "inverted. 60 is best of a triangle, 90 of a quadrilateral, more of a polygon.",
            Better::smaller, ColorRange::from_zero, 120, {.unit = "degrees"}),
        largest_angle, 60),
    MetricInfo(
        Metric::skewness,
        FieldInfo(
            "skewness", "Skewness",
            "Equiangle skewness: how far the worst angle is from 60 degrees (90 of a "
            "quadrilateral), relative to the farthest it can be. 0 is best, 1 degenerate, more "
            "is inverted.",
            Better::smaller, ColorRange::from_zero, 0.5),
        skewness, 0),
    MetricInfo(Metric::area,
               FieldInfo("area", "Area", "Signed area, in squared units of the mesh.",
                         Better::larger, ColorRange::robust_both_sides, 0,
                         {.has_sign = true, .unit = "squared units of the mesh"}),
               area),
};

constexpr std::array volume_metrics{
    MetricInfo(
        Metric::normalized_jacobian,
        FieldInfo("normalized_jacobian", "Scaled Jacobian",
                  "Determinant of the edges at every corner over their lengths: 1 for the regular "
                  "element, negative where an element is inverted. Larger is better.",
                  Better::larger, ColorRange::zero_to_one, 0.2, {.has_sign = true}),
        &VolumeElement::scaled_jacobian, 1),
    MetricInfo(
        Metric::aspect_ratio,
        FieldInfo(
            "aspect_ratio", "Aspect ratio",
            "R/3r, circumradius over three times the inradius. 1 is best for a mesh that is not "
            "stretched on purpose. Inverted elements are left out.",
            Better::smaller, ColorRange::from_one, 3, {.judged = false}),
        &VolumeElement::radius_ratio, 1),
    MetricInfo(Metric::condition_number,
               FieldInfo("condition_number", "Condition number", condition_help, Better::smaller,
                         ColorRange::from_one, 3, {.judged = false}),
               &VolumeElement::condition_number, 1),
    MetricInfo(
        Metric::smallest_solid_angle,
        FieldInfo("smallest_solid_angle", "Smallest solid angle",
                  "Smallest solid angle of an element's corners, in steradians, negative where a "
                  "corner is inverted. 0.551 is best of a tetrahedron, 1.571 of a hexahedron.",
                  Better::larger, ColorRange::robust_both_sides, 0.1, {.unit = "steradians"}),
        &VolumeElement::smallest_solid_angle, pi / 2),
    MetricInfo(
        Metric::largest_solid_angle,
        FieldInfo("largest_solid_angle", "Largest solid angle",
                  "Largest solid angle of an element's corners, in steradians. 0.551 is best of a "
                  "tetrahedron, 1.571 of a hexahedron.",
                  Better::smaller, ColorRange::from_zero, 2, {.unit = "steradians"}),
        &VolumeElement::largest_solid_angle, 0.5),
    MetricInfo(Metric::volume,
               FieldInfo("volume", "Volume", "Signed volume, in cubed units of the mesh.",
                         Better::larger, ColorRange::robust_both_sides, 0,
                         {.has_sign = true, .unit = "cubed units of the mesh"}),
               &VolumeElement::volume),
    MetricInfo(
        Metric::non_orthogonality,
        FieldInfo("non_orthogonality", "Non-orthogonality",
                  "OpenFOAM's: largest angle between the normal of a face and the line between the "
                  "centres of its two cells, in degrees. 0 is best; above 70 checkMesh warns.",
                  Better::smaller, ColorRange::from_zero, 70, {.unit = "degrees"}),
        &FiniteVolumes::non_orthogonality, 0),
    MetricInfo(
        Metric::skewness,
        FieldInfo("skewness", "Skewness",
                  "OpenFOAM's: largest distance of a face's centre from the line between the "
                  "centres of its two cells, relative to the face. 0 is best; above 4 checkMesh "
                  "fails.",
                  Better::smaller, ColorRange::from_zero, 4),
        &FiniteVolumes::skewness, 0),
    MetricInfo(
        Metric::cell_aspect_ratio,
        FieldInfo("cell_aspect_ratio", "Cell aspect ratio",
                  "OpenFOAM's: ratio of the areas of the faces as seen along x, y and z. 1 is best "
                  "for a mesh that is not stretched on purpose; above 1000 checkMesh fails.",
                  Better::smaller, ColorRange::from_one, 1000, {.judged = false}),
        &FiniteVolumes::aspect_ratio, 1),
    MetricInfo(
        Metric::determinant,
        FieldInfo("determinant", "Cell determinant",
                  "OpenFOAM's: determinant of the area vectors of the internal faces. 1 for a cube "
                  "inside a mesh, 0 without neighbours in one direction; checkMesh -allGeometry "
                  "fails below 0.001.",
                  Better::larger, ColorRange::zero_to_one, 0.001),
        &FiniteVolumes::determinant, 1),
    MetricInfo(
        Metric::volume_ratio,
        FieldInfo("volume_ratio", "Volume ratio",
                  "OpenFOAM's: smallest ratio of the volumes of an element and a neighbour. 1 is "
                  "best; checkMesh -allGeometry fails below 0.01.",
                  Better::larger, ColorRange::zero_to_one, 0.01),
        &FiniteVolumes::volume_ratio, 1),
    MetricInfo(
        Metric::face_pyramid,
        FieldInfo("face_pyramid", "Face pyramid",
                  "Smallest volume of the pyramids over an element's faces, with their apex in its "
                  "centre, relative to their mean. 1 is best; checkMesh fails where it is "
                  "negative.",
                  Better::larger, ColorRange::up_to_one, 0, {.has_sign = true}),
        &FiniteVolumes::face_pyramid, 1),
};

/// All metrics of elements of one dimension.
struct MetricTable {
  explicit MetricTable(const char* which, std::span<const MetricInfo> infos)
      : elements(which), rows(infos) {
    for (const MetricInfo& info : rows) {
      all.push_back(info.metric);
      if (info.reported) reported.push_back(info.metric);
    }
    rating = reported;
    for (const MetricInfo& info : rows)
      if (info.rates() && !info.reported) rating.push_back(info.metric);
  }

  const char* elements;
  std::span<const MetricInfo> rows;
  std::vector<Metric> all, reported, rating;
};

const MetricTable& table(int cell_dimension) {
  static const std::array tables{MetricTable("plane", plane_metrics),
                                 MetricTable("volume", volume_metrics)};
  return tables.at(static_cast<std::size_t>(cell_dimension) - 2);
}

const MetricInfo* find_info(Metric metric, int cell_dimension) {
  const auto rows = table(cell_dimension).rows;
  const auto found = std::ranges::find(rows, metric, &MetricInfo::metric);
  return found == rows.end() ? nullptr : &*found;
}

/// The row of the lowest dimension that has the metric, for its name.
const MetricInfo& any_info(Metric metric) {
  const MetricInfo* plane = find_info(metric, 2);
  return plane ? *plane : metric_info(metric, 3);
}

}  // namespace

const MetricInfo& metric_info(Metric metric, int cell_dimension) {
  if (const MetricInfo* info = find_info(metric, cell_dimension)) return *info;
  throw UsageError(std::string(table(cell_dimension).elements) + " elements have no metric '" +
                   std::string(metric_name(metric)) + "'");
}

const std::vector<Metric>& all_metrics(int cell_dimension) { return table(cell_dimension).all; }

const std::vector<Metric>& reported_metrics(int cell_dimension) {
  return table(cell_dimension).reported;
}

const std::vector<Metric>& rating_metrics(int cell_dimension) {
  return table(cell_dimension).rating;
}

std::string_view metric_name(Metric metric) { return any_info(metric).field.name; }
std::string_view metric_label(Metric metric) { return any_info(metric).field.label; }

Metric parse_metric(std::string_view name, int cell_dimension) {
  const auto& all = all_metrics(cell_dimension);
  const auto found = std::ranges::find(all, name, metric_name);
  if (found != all.end()) return *found;
  throw UsageError("unknown metric '" + std::string(name) +
                   "', expected one of: " + listed(all, metric_name));
}

}  // namespace winslow
