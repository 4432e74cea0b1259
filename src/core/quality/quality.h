#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/mesh/mesh.h"

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
/// - area: signed area of the element, in squared units of the file.
/// All of them are for plane meshes; everything here throws UsageError for another.
/// An element is inverted if any of its corners has an area that is not positive. Aspect ratio and
/// condition number of an inverted element are infinite; statistics leave them out.
enum class Metric { normalized_jacobian, aspect_ratio, condition_number, area };

std::string_view metric_name(Metric metric);   ///< "normalized_jacobian", as in files and options
std::string_view metric_label(Metric metric);  ///< "Normalized Jacobian", as on screen
/// By metric_name. Throws UsageError listing the names.
Metric parse_metric(std::string_view name);

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

/// Quality of a whole mesh. Statistics of the normalized Jacobian run over all corners of all
/// elements, those of the others over all elements that are not inverted.
struct QualityReport {
  Index elements = 0;
  Index inverted = 0;
  std::vector<Index> inverted_elements;  ///< first 100
  struct PerMetric {
    Statistics statistics;
    Histogram histogram;
    std::vector<WorstElement> worst;
  };
  PerMetric normalized_jacobian, aspect_ratio, condition_number;

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
