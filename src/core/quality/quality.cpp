#include "core/quality/quality.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/error.h"
#include "core/parallel/parallel_for.h"
#include "core/quality/corner.h"
#include "core/quality/corner_kernel.h"

namespace winslow {

namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

struct MetricNames {
  Metric metric;
  std::string_view name, label;
};
constexpr std::array<MetricNames, 4> metric_names{{
    {Metric::normalized_jacobian, "normalized_jacobian", "Normalized Jacobian"},
    {Metric::aspect_ratio, "aspect_ratio", "Aspect ratio"},
    {Metric::condition_number, "condition_number", "Condition number"},
    {Metric::area, "area", "Area"},
}};

const MetricNames& names_of(Metric metric) {
  return *std::find_if(metric_names.begin(), metric_names.end(),
                       [&](const MetricNames& n) { return n.metric == metric; });
}

/// R/(2r) of half a square: the value that a quadrilateral's corners are measured against.
const double square_radius_ratio = (1 + std::sqrt(2.0)) / 2;

struct ElementMetrics {
  double min_sine = 1;
  double aspect_ratio = 0;
  double condition_number = 0;
  double area = 0;
  bool inverted = false;
};

ElementMetrics measure_triangle(const Coordinates& x, std::span<const Index> element) {
  ElementMetrics m;
  // The three corners have one area, but for a flat triangle round-off may disagree on its sign.
  for (std::size_t k = 0; k < 3; ++k) {
    const Corner corner = corner_of(x, element, k);
    m.min_sine = std::min(m.min_sine, corner.sine());
    m.inverted = m.inverted || corner.inverted();
    m.aspect_ratio = std::max(m.aspect_ratio, corner.radius_ratio());
    m.condition_number = std::max(m.condition_number, corner.triangle_condition());
  }
  m.area = 0.5 * corner_of(x, element, 0).area2;
  return m;
}

ElementMetrics measure_quadrilateral(const Coordinates& x, std::span<const Index> element) {
  ElementMetrics m;
  for (std::size_t k = 0; k < 4; ++k) {
    const Corner corner = corner_of(x, element, k);
    m.min_sine = std::min(m.min_sine, corner.sine());
    m.inverted = m.inverted || corner.inverted();
    m.aspect_ratio = std::max(m.aspect_ratio, corner.radius_ratio() / square_radius_ratio);
    m.condition_number = std::max(m.condition_number, corner.square_condition());
    m.area += 0.25 * corner.area2;
  }
  return m;
}

ElementMetrics measure(const Coordinates& x, std::span<const Index> element) {
  return element.size() == 3 ? measure_triangle(x, element) : measure_quadrilateral(x, element);
}

double value_of(const ElementMetrics& m, Metric metric) {
  switch (metric) {
    case Metric::normalized_jacobian:
      return m.min_sine;
    case Metric::aspect_ratio:
      return m.aspect_ratio;
    case Metric::condition_number:
      return m.condition_number;
    case Metric::area:
      return m.area;
  }
  return 0;
}

Statistics statistics_of(std::span<const double> values) {
  Statistics s;
  if (values.empty()) return s;
  s.min = s.max = values.front();
  double sum = 0;
  for (const double v : values) {
    s.min = std::min(s.min, v);
    s.max = std::max(s.max, v);
    sum += v;
  }
  s.avg = sum / static_cast<double>(values.size());
  return s;
}

Histogram histogram_of(std::span<const double> values, double low, double high, int bins) {
  Histogram h{low, high, std::vector<Index>(static_cast<std::size_t>(std::max(1, bins)), 0)};
  const auto last = static_cast<double>(h.counts.size() - 1);
  for (const double v : values) {
    const double t = high > low ? (v - low) / (high - low) : 0;
    const double bin = std::clamp(std::floor(t * static_cast<double>(h.counts.size())), 0.0, last);
    ++h.counts[static_cast<std::size_t>(bin)];
  }
  return h;
}

Vec2 centre_of(const Mesh& mesh, Index e) {
  Vec2 sum(0, 0);
  const auto nodes = mesh.topology->element(e);
  for (const Index node : nodes) sum += mesh.coordinates.xy(node);
  return sum / static_cast<double>(nodes.size());
}

/// The elements with the smallest (or largest) values, worst first, ties by index.
std::vector<WorstElement> worst_of(const Mesh& mesh, std::span<const double> values, bool smallest,
                                   int count) {
  std::vector<Index> order(values.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<Index>(i);
  const auto n = std::min(order.size(), static_cast<std::size_t>(std::max(0, count)));
  std::partial_sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(n), order.end(),
                    [&](Index a, Index b) {
                      const double va = smallest ? values[at(a)] : -values[at(a)];
                      const double vb = smallest ? values[at(b)] : -values[at(b)];
                      return va != vb ? va < vb : a < b;
                    });
  std::vector<WorstElement> worst;
  for (std::size_t i = 0; i < n; ++i) {
    worst.push_back({order[i], values[at(order[i])], centre_of(mesh, order[i])});
  }
  return worst;
}

}  // namespace

std::string_view metric_name(Metric metric) { return names_of(metric).name; }
std::string_view metric_label(Metric metric) { return names_of(metric).label; }

Metric parse_metric(std::string_view name) {
  std::string known;
  for (const auto& entry : metric_names) {
    if (entry.name == name) return entry.metric;
    known += (known.empty() ? "" : ", ") + std::string(entry.name);
  }
  throw UsageError("unknown metric '" + std::string(name) + "', expected one of: " + known);
}

const QualityReport::PerMetric& QualityReport::of(Metric metric) const {
  switch (metric) {
    case Metric::normalized_jacobian:
      return normalized_jacobian;
    case Metric::aspect_ratio:
      return aspect_ratio;
    case Metric::condition_number:
      return condition_number;
    case Metric::area:
      break;
  }
  throw UsageError("the quality report has no statistics of the area");
}

QualityReport measure_quality(const Mesh& mesh, const QualityOptions& options) {
  const Topology& topology = *mesh.topology;
  require_plane(topology, "quality");
  const Index n = topology.element_count();
  std::vector<ElementMetrics> metrics(at(n));
  std::vector<double> sines(topology.elements().values.size());
  parallel_for(options.threads, n, [&](Index begin, Index end) {
    for (Index e = begin; e < end; ++e) {
      const auto element = topology.element(e);
      metrics[at(e)] = measure(mesh.coordinates, element);
      for (std::size_t k = 0; k < element.size(); ++k) {
        sines[at(topology.elements().offsets[at(e)]) + k] =
            corner_of(mesh.coordinates, element, k).sine();
      }
    }
  });

  QualityReport report;
  report.elements = n;
  constexpr std::size_t listed = 100;
  for (Index e = 0; e < n; ++e) {
    if (!metrics[at(e)].inverted) continue;
    ++report.inverted;
    if (report.inverted_elements.size() < listed) report.inverted_elements.push_back(e);
  }
  const auto values = [&](Metric metric) {
    std::vector<double> all(at(n));
    for (Index e = 0; e < n; ++e) all[at(e)] = value_of(metrics[at(e)], metric);
    return all;
  };
  const auto minima = values(Metric::normalized_jacobian);
  report.normalized_jacobian.statistics = statistics_of(sines);
  report.normalized_jacobian.histogram = histogram_of(
      sines, std::min(0.0, report.normalized_jacobian.statistics.min), 1, options.histogram_bins);
  report.normalized_jacobian.worst = worst_of(mesh, minima, true, options.worst);
  for (const Metric metric : {Metric::aspect_ratio, Metric::condition_number}) {
    auto& part = metric == Metric::aspect_ratio ? report.aspect_ratio : report.condition_number;
    const auto all = values(metric);
    part.worst = worst_of(mesh, all, false, options.worst);
    std::vector<double> valid;
    for (const double v : all) {
      if (std::isfinite(v)) valid.push_back(v);
    }
    part.statistics = statistics_of(valid);
    part.histogram = histogram_of(valid, 1, part.statistics.max, options.histogram_bins);
  }
  return report;
}

std::vector<double> element_values(const Mesh& mesh, Metric metric) {
  require_plane(*mesh.topology, "quality");
  std::vector<double> values(at(mesh.topology->element_count()));
  parallel_for(0, mesh.topology->element_count(), [&](Index begin, Index end) {
    for (Index e = begin; e < end; ++e) {
      values[at(e)] = value_of(measure(mesh.coordinates, mesh.topology->element(e)), metric);
    }
  });
  return values;
}

double element_value(const Mesh& mesh, Index element, Metric metric) {
  require_plane(*mesh.topology, "quality");
  return value_of(measure(mesh.coordinates, mesh.topology->element(element)), metric);
}

Validity check_validity(const Topology& topology, const Coordinates& coordinates, int threads) {
  require_plane(topology, "quality");
  coordinates.require_dimension(2);
  const CornerData data{coordinates.values().data(), topology.elements().offsets.data(),
                        topology.elements().values.data()};
  const CornerKernel avx2 = avx2_corner_kernel();
  const CornerKernel summarise = avx2 ? avx2 : portable_corner_kernel();
  const Index n = topology.element_count();
  std::vector<CornerSummary> blocks(at((n + parallel_block - 1) / parallel_block));
  parallel_for(threads, n, [&](Index begin, Index end) {
    blocks[at(begin / parallel_block)] = summarise(data, begin, end);
  });
  Validity total{0, 1.0};
  for (const CornerSummary& v : blocks) {
    total.inverted += v.inverted;
    total.min_sine = std::min(total.min_sine, v.min_sine);
  }
  return total;
}

}  // namespace winslow
