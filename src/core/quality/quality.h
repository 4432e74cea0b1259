#pragma once

#include "core/mesh/mesh.h"
#include "core/quality/metric.h"
#include "core/quality/surface_folds.h"
#include "core/quality/validity.h"
#include "core/quality/wall_measures.h"

/// The worst elements:
///
///     const auto values = winslow::element_values(mesh, winslow::Metric::aspect_ratio);
///     const auto& field = winslow::metric_info(winslow::Metric::aspect_ratio).field;
///     for (const winslow::WorstElement& worst : winslow::worst_elements(mesh, values, field, 5))
///       std::printf("%d: %g\n", worst.element, worst.value);
namespace winslow {

struct WorstElement {
  Index element;
  double value;
  Vec3 centre;  ///< z is 0 in the plane
};

/// Mean of the corners of an element, in units of the mesh. z is 0 in the plane.
Vec3 element_centre(const Mesh& mesh, Index element);

/// At most `count` elements with the worst values of a field, worst first, equal values by index.
/// Elements without a value (NaN) are left out. values: #elements.
std::vector<WorstElement> worst_elements(const Mesh& mesh, std::span<const double> values,
                                         const FieldInfo& field, int count);

/// Statistics, and the value of each element:
///
///     const winslow::QualityReport report = winslow::measure_quality(mesh);
///     const auto& sine = report.of(winslow::Metric::normalized_jacobian);
///     std::printf("%d inverted, smallest sine %.3f\n", report.inverted, sine.statistics.min);
///     const auto values = winslow::element_values(mesh, winslow::Metric::normalized_jacobian);

/// The metrics of a surface mesh are those of the plane, with each corner in its own plane. The
/// sign of a corner is that of the reference normal of its element (ElementNormals). Without
/// reference normals it is that of the element's own area vector: then a triangle is never
/// inverted, and a quadrilateral is inverted if it is folded or not convex.
struct Statistics {
  double min = 0, avg = 0, max = 0;
};
/// All 0 for no values.
Statistics statistics_of(std::span<const double> values);

struct Histogram {
  double low = 0, high = 1;
  std::vector<Index> counts;
};

struct QualityOptions {
  int histogram_bins = 20;
  int worst = 10;   ///< how many worst elements to list for each metric and wall field
  int threads = 0;  ///< 0 for all cores
  /// For a surface mesh: reference normals (#elements); empty: the elements' own normals.
  std::vector<Vec3> normals;
  /// Earlier coordinates of the nodes (#nodes by the dimension of the mesh), for
  /// WallField::first_height_ratio; null: no list for it.
  const Coordinates* before = nullptr;
};

/// Quality of a whole mesh.
struct QualityReport {
  int cell_dimension = 2, space_dimension = 2;
  Index elements = 0;
  Index inverted = 0;
  std::vector<Index> inverted_elements;  ///< first 100
  struct PerMetric {
    Statistics statistics;  ///< of all elements; NaN where none has a finite value
    /// The same without the elements that all_on_boundary counts: what smoothing can change.
    Statistics movable;
    Histogram histogram;
    std::vector<WorstElement> worst;
  };
  std::vector<PerMetric> metrics;  ///< of reported_metrics(cell_dimension), in their order
  /// Elements of a volume mesh with all nodes on the boundary, which no smoothing can change. They
  /// are in everything above but PerMetric::movable.
  Index all_on_boundary = 0, all_on_boundary_inverted = 0;
  SurfaceFolds folds;                                     ///< of surface meshes
  WallReport walls;                                       ///< of plane and volume meshes
  std::vector<std::vector<WorstElement>> worst_at_walls;  ///< of all_wall_fields(), in their order

  /// Plane and volume meshes have walls, surface meshes have none.
  bool has_walls() const { return cell_dimension == space_dimension; }
  /// Throws UsageError for a metric that is not reported.
  const PerMetric& of(Metric metric) const&;
  PerMetric of(Metric metric) &&;  ///< a copy, since the report is a temporary
  const std::vector<WorstElement>& worst_by(WallField field) const {
    return worst_at_walls[static_cast<std::size_t>(field)];
  }
};

QualityReport measure_quality(const Mesh& mesh, const QualityOptions& options = {});

/// True if all nodes of an element lie on the boundary.
bool all_on_boundary(const Topology& topology, Index e);

/// Value of a metric for each element (#elements). normals: as in QualityOptions.
std::vector<double> element_values(const Mesh& mesh, Metric metric,
                                   std::span<const Vec3> normals = {});
/// The same of several metrics, in their order; faster than one after another.
std::vector<std::vector<double>> element_values(const Mesh& mesh, std::span<const Metric> metrics,
                                                std::span<const Vec3> normals = {},
                                                int threads = 0);
/// The first element with the worst value of a metric. The mesh must have elements.
Index worst_element(const Mesh& mesh, Metric metric);
/// The value of one element. normals: as in QualityOptions.
double element_value(const Mesh& mesh, Index element, Metric metric,
                     std::span<const Vec3> normals = {});

/// Whether an element of a plane or volume mesh is inverted.
bool is_inverted(const Topology& topology, const Coordinates& coordinates, Index element);

/// Counts inverted elements; much faster than a report. threads: 0 for all cores; the result does
/// not depend on it. normals: of a surface mesh, as in QualityOptions.
Validity check_validity(const Topology& topology, const Coordinates& coordinates, int threads = 0,
                        std::span<const Vec3> normals = {});

}  // namespace winslow
