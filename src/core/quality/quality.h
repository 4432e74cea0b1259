#pragma once

#include <vector>

#include "core/mesh/mesh.h"
#include "core/quality/metric.h"
#include "core/quality/validity.h"
#include "core/quality/wall_measures.h"

namespace winslow {

/// The metrics are for plane meshes: everything here throws UsageError for another.
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
  Vec2 centre;
};

struct QualityOptions {
  int histogram_bins = 20;
  int worst = 10;   ///< how many worst elements to list for each metric
  int threads = 0;  ///< 0 for all cores
};

/// Quality of a whole mesh.
struct QualityReport {
  Index elements = 0;
  Index inverted = 0;
  std::vector<Index> inverted_elements;  ///< first 100
  struct PerMetric {
    Statistics statistics;
    Histogram histogram;
    std::vector<WorstElement> worst;
  };
  std::vector<PerMetric> metrics;  ///< of reported_metrics(), in their order
  WallReport walls;

  /// Throws UsageError for a metric that is not reported.
  const PerMetric& of(Metric metric) const&;
  PerMetric of(Metric metric) &&;  ///< a copy: the report is about to go
};

QualityReport measure_quality(const Mesh& mesh, const QualityOptions& options = {});

/// Value of a metric for each element (#elements).
std::vector<double> element_values(const Mesh& mesh, Metric metric);
/// The element that is worst by a metric; the first of several. mesh: plane, with elements.
Index worst_element(const Mesh& mesh, Metric metric);
/// The value of one element.
double element_value(const Mesh& mesh, Index element, Metric metric);
/// Mean of an element's corners, in units of the mesh: tells a user where to look.
Vec2 element_centre(const Mesh& mesh, Index element);

/// Cheaper than a report. threads: 0 for all cores; the result does not depend on it.
Validity check_validity(const Topology& topology, const Coordinates& coordinates, int threads = 0);

}  // namespace winslow
