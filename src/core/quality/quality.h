#pragma once

#include <vector>

#include "core/mesh/mesh.h"
#include "core/quality/metric.h"

namespace winslow {

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

  /// Throws UsageError for a metric that is not reported.
  const PerMetric& of(Metric metric) const;
};

QualityReport measure_quality(const Mesh& mesh, const QualityOptions& options = {});

/// Value of a metric for each element (#elements).
std::vector<double> element_values(const Mesh& mesh, Metric metric);
/// The same of one element.
double element_value(const Mesh& mesh, Index element, Metric metric);

/// What every outer iteration needs to know, cheaply.
struct Validity {
  Index inverted = 0;
  double min_sine = 0;
};
Validity check_validity(const Topology& topology, const Coordinates& coordinates, int threads = 0);

}  // namespace winslow
