#pragma once

#include <vector>

#include "core/mesh/mesh.h"
#include "core/quality/metric.h"
#include "core/quality/validity.h"
#include "core/quality/wall_measures.h"

namespace winslow {

/// Metrics of plane and of volume meshes: everything here throws UsageError for a surface mesh.
struct Statistics {
  double min = 0, avg = 0, max = 0;
};

struct Histogram {
  double low = 0, high = 1;
  std::vector<Index> counts;
};

struct WorstElement {
  Index element;
  double value;
  Vec3 centre;  ///< z is 0 in the plane
};

struct QualityOptions {
  int histogram_bins = 20;
  int worst = 10;   ///< how many worst elements to list for each metric
  int threads = 0;  ///< 0 for all cores
};

/// Quality of a whole mesh.
struct QualityReport {
  int cell_dimension = 2;
  Index elements = 0;
  Index inverted = 0;
  std::vector<Index> inverted_elements;  ///< first 100
  struct PerMetric {
    Statistics statistics;
    Histogram histogram;
    std::vector<WorstElement> worst;
  };
  std::vector<PerMetric> metrics;  ///< of reported_metrics(cell_dimension), in their order
  /// Elements of a volume mesh whose nodes all lie on the boundary: no smoothing can change them.
  /// They are counted above, too.
  Index all_on_boundary = 0, all_on_boundary_inverted = 0;
  WallReport walls;  ///< of plane meshes

  /// Throws UsageError for a metric that is not reported.
  const PerMetric& of(Metric metric) const&;
  PerMetric of(Metric metric) &&;  ///< a copy: the report is about to go
};

QualityReport measure_quality(const Mesh& mesh, const QualityOptions& options = {});

/// Value of a metric for each element (#elements).
std::vector<double> element_values(const Mesh& mesh, Metric metric);
/// The same of one element.
double element_value(const Mesh& mesh, Index element, Metric metric);
/// Mean of an element's corners, in units of the mesh: tells a user where to look. z is 0 in the
/// plane.
Vec3 element_centre(const Mesh& mesh, Index element);

/// Cheaper than a report. threads: 0 for all cores; the result does not depend on it.
Validity check_validity(const Topology& topology, const Coordinates& coordinates, int threads = 0);

}  // namespace winslow
