#include "core/quality/quality.h"

#include <utility>

#include "core/error.h"
#include "core/geometry/element_normals.h"
#include "core/parallel/parallel_for.h"
#include "core/quality/corner.h"
#include "core/quality/corner_kernel.h"

namespace winslow {

namespace {

/// The corners of one element, in the order of its nodes.
class ElementCorners {
 public:
  ElementCorners(const Coordinates& x, std::span<const Index> element) : count_(element.size()) {
    for (std::size_t k = 0; k < count_; ++k) corners_[k] = corner_of(x, element, k);
  }
  ElementCorners(const SpacePoints& x, std::span<const Index> element, const Vec3& normal)
      : count_(element.size()) {
    for (std::size_t k = 0; k < count_; ++k) corners_[k] = corner_of(x, element, k, normal);
  }
  std::span<const Corner> span() const { return {corners_.data(), count_}; }
  /// Each counts: for a flat triangle round-off may disagree on the sign of its one area.
  bool inverted() const {
    return std::ranges::any_of(span(), [](const Corner& corner) { return corner.inverted(); });
  }

 private:
  std::array<Corner, 4> corners_;
  std::size_t count_;
};

/// Of a plane mesh or a surface mesh. normals: reference normals; empty: there are none.
ElementCorners corners_of(const Mesh& mesh, std::span<const Vec3> normals, Index e) {
  const auto element = mesh.topology->element(e);
  if (!is_surface(*mesh.topology)) return {mesh.coordinates, element};
  const SpacePoints x(mesh.coordinates);
  return {x, element, normals.empty() ? area_vector(x, element) : normals[at(e)]};
}

VolumeElement volume_element(const Mesh& mesh, Index e) {
  return {mesh.coordinates, mesh.topology->element_type(e), mesh.topology->element(e)};
}

double value_of(const Mesh& mesh, std::span<const Vec3> normals, Index e, Metric metric) {
  const int dimension = mesh.topology->cell_dimension();
  const MetricInfo& info = metric_info(metric, dimension);
  if (dimension == 3) return info.of_volume(volume_element(mesh, e));
  return info.of_element(corners_of(mesh, normals, e).span());
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

std::vector<double> finite(std::span<const double> values) {
  std::vector<double> list;
  for (const double v : values) {
    if (std::isfinite(v)) list.push_back(v);
  }
  return list;
}

/// Values of the reported metrics, in their order.
struct Values {
  Values(const Mesh& mesh, std::span<const Vec3> normals, int threads);

  std::vector<std::vector<double>> of_elements;  ///< #elements each
  std::vector<std::vector<double>> of_corners;   ///< #corners each; empty where there are none
  std::vector<char> inverted;                    ///< #elements
};

Values::Values(const Mesh& mesh, std::span<const Vec3> normals, int threads) {
  const Topology& topology = *mesh.topology;
  const int dimension = topology.cell_dimension();
  const auto& reported = reported_metrics(dimension);
  const auto elements = at(topology.element_count());
  inverted.resize(elements);
  of_corners.resize(reported.size());
  of_elements.assign(reported.size(), std::vector<double>(elements));
  for (std::size_t m = 0; m < reported.size(); ++m) {
    if (metric_info(reported[m], dimension).of_corner)
      of_corners[m].resize(topology.elements().values.size());
  }
  if (dimension == 3) {
    parallel_for(threads, topology.element_count(), [&](Index begin, Index end) {
      for (Index e = begin; e < end; ++e) {
        const VolumeElement element = volume_element(mesh, e);
        inverted[at(e)] = element.inverted();
        for (std::size_t m = 0; m < reported.size(); ++m)
          of_elements[m][at(e)] = metric_info(reported[m], 3).of_volume(element);
      }
    });
    return;
  }
  parallel_for(threads, topology.element_count(), [&](Index begin, Index end) {
    for (Index e = begin; e < end; ++e) {
      const ElementCorners corners = corners_of(mesh, normals, e);
      inverted[at(e)] = corners.inverted();
      const auto first = at(topology.elements().offsets[at(e)]);
      for (std::size_t m = 0; m < reported.size(); ++m) {
        const MetricInfo& info = metric_info(reported[m]);
        of_elements[m][at(e)] = info.of_element(corners.span());
        if (!info.of_corner) continue;
        for (std::size_t k = 0; k < corners.span().size(); ++k)
          of_corners[m][first + k] = info.of_corner(corners.span()[k]);
      }
    }
  });
}

/// Takes the elements that no smoothing can change out of what is measured, and counts them.
void set_fixed_apart(const Topology& topology, Values& values, QualityReport& report) {
  for (Index e = 0; e < topology.element_count(); ++e) {
    if (!all_on_boundary(topology, e)) continue;
    ++report.all_on_boundary;
    if (values.inverted[at(e)]) ++report.all_on_boundary_inverted;
    for (auto& of_metric : values.of_elements)
      of_metric[at(e)] = std::numeric_limits<double>::quiet_NaN();
  }
}

}  // namespace

bool all_on_boundary(const Topology& topology, Index e) {
  return std::ranges::all_of(topology.element(e),
                             [&](Index node) { return topology.on_boundary(node); });
}

const QualityReport::PerMetric& QualityReport::of(Metric metric) const& {
  const auto& reported = reported_metrics(cell_dimension);
  const auto found = std::find(reported.begin(), reported.end(), metric);
  if (found == reported.end()) {
    throw UsageError("the quality report has no statistics of the " +
                     std::string(metric_name(metric)));
  }
  return metrics[static_cast<std::size_t>(found - reported.begin())];
}

QualityReport::PerMetric QualityReport::of(Metric metric) && {
  return std::as_const(*this).of(metric);
}

QualityReport measure_quality(const Mesh& mesh, const QualityOptions& options) {
  Values values(mesh, options.normals, options.threads);
  QualityReport report;
  report.cell_dimension = mesh.topology->cell_dimension();
  report.space_dimension = mesh.topology->space_dimension();
  if (report.cell_dimension == 3) set_fixed_apart(*mesh.topology, values, report);
  report.elements = mesh.topology->element_count();
  constexpr std::size_t listed = 100;
  for (Index e = 0; e < report.elements; ++e) {
    if (!values.inverted[at(e)]) continue;
    ++report.inverted;
    if (report.inverted_elements.size() < listed) report.inverted_elements.push_back(e);
  }
  for (std::size_t m = 0; m < values.of_elements.size(); ++m) {
    const MetricInfo& info =
        metric_info(reported_metrics(report.cell_dimension)[m], report.cell_dimension);
    auto& part = report.metrics.emplace_back();
    const auto& all = values.of_elements[m];
    part.worst = worst_elements(mesh, all, info.field, options.worst);
    const auto counted = info.of_corner ? values.of_corners[m] : finite(all);
    part.statistics = statistics_of(counted);
    const double low = info.field.larger_is_better ? std::min(0.0, part.statistics.min) : info.best;
    const double high = info.field.larger_is_better ? info.best : part.statistics.max;
    part.histogram = histogram_of(counted, low, high, options.histogram_bins);
  }
  if (!report.has_walls()) return report;
  report.walls = measure_walls(mesh);
  for (const WallField field : all_wall_fields()) {
    report.worst_at_walls.push_back(
        options.worst > 0 ? worst_elements(mesh, element_values(mesh, field, options.before),
                                           wall_field_info(field), options.worst)
                          : std::vector<WorstElement>());
  }
  return report;
}

std::vector<double> element_values(const Mesh& mesh, Metric metric, std::span<const Vec3> normals) {
  std::vector<double> values(at(mesh.topology->element_count()));
  parallel_for(0, mesh.topology->element_count(), [&](Index begin, Index end) {
    for (Index e = begin; e < end; ++e) {
      values[at(e)] = value_of(mesh, normals, e, metric);
    }
  });
  return values;
}

Index worst_element(const Mesh& mesh, Metric metric) {
  const std::vector<double> values = element_values(mesh, metric);
  const FieldInfo& info = metric_info(metric, mesh.topology->cell_dimension()).field;
  const auto worst =
      info.larger_is_better ? std::ranges::min_element(values) : std::ranges::max_element(values);
  return static_cast<Index>(worst - values.begin());
}

double element_value(const Mesh& mesh, Index element, Metric metric,
                     std::span<const Vec3> normals) {
  return value_of(mesh, normals, element, metric);
}

namespace {

/// add(element, validity so far): of all elements together.
template <typename Add>
Validity check_elements(Index n, int threads, const Add& add) {
  std::vector<Validity> blocks(at((n + parallel_block - 1) / parallel_block), Validity{0, 1.0});
  parallel_for(threads, n, [&](Index begin, Index end) {
    for (Index e = begin; e < end; ++e) add(e, blocks[at(begin / parallel_block)]);
  });
  Validity total{0, 1.0};
  for (const Validity& v : blocks) {
    total.inverted += v.inverted;
    total.min_sine = std::min(total.min_sine, v.min_sine);
  }
  return total;
}

Validity check_volume(const Topology& topology, const Coordinates& coordinates, int threads) {
  return check_elements(topology.element_count(), threads, [&](Index e, Validity& sum) {
    const VolumeElement element(coordinates, topology.element_type(e), topology.element(e));
    sum.inverted += element.inverted() ? 1 : 0;
    if (!all_on_boundary(topology, e))
      sum.min_sine = std::min(sum.min_sine, element.scaled_jacobian());
  });
}

Validity check_surface(const Topology& topology, const Coordinates& coordinates,
                       std::span<const Vec3> normals, int threads) {
  const SpacePoints x(coordinates);
  return check_elements(topology.element_count(), threads, [&](Index e, Validity& sum) {
    const auto element = topology.element(e);
    const ElementCorners corners(x, element,
                                 normals.empty() ? area_vector(x, element) : normals[at(e)]);
    sum.inverted += corners.inverted() ? 1 : 0;
    for (const Corner& corner : corners.span())
      sum.min_sine = std::min(sum.min_sine, corner.sine());
  });
}

}  // namespace

Validity check_validity(const Topology& topology, const Coordinates& coordinates, int threads,
                        std::span<const Vec3> normals) {
  coordinates.require_dimension(topology.space_dimension());
  if (topology.cell_dimension() == 3) return check_volume(topology, coordinates, threads);
  if (is_surface(topology)) return check_surface(topology, coordinates, normals, threads);
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

namespace {

/// The larger, the worse.
double badness(const FieldInfo& field, double value) {
  if (field.one_is_best) return std::abs(std::log(value));
  return field.larger_is_better ? -value : value;
}

}  // namespace

Vec3 element_centre(const Mesh& mesh, Index element) {
  Vec3 sum(0, 0, 0);
  const auto nodes = mesh.topology->element(element);
  const bool plane = mesh.coordinates.dimension() == 2;
  for (const Index node : nodes) {
    if (plane) {
      sum.head<2>() += mesh.coordinates.xy(node);
    } else {
      sum += mesh.coordinates.xyz(node);
    }
  }
  return sum / static_cast<double>(nodes.size());
}

std::vector<WorstElement> worst_elements(const Mesh& mesh, std::span<const double> values,
                                         const FieldInfo& field, int count) {
  std::vector<Index> order;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (!std::isnan(values[i])) order.push_back(static_cast<Index>(i));
  const auto n = std::min(order.size(), static_cast<std::size_t>(std::max(0, count)));
  std::partial_sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(n), order.end(),
                    [&](Index a, Index b) {
                      const double bad_a = badness(field, values[at(a)]);
                      const double bad_b = badness(field, values[at(b)]);
                      return bad_a != bad_b ? bad_a > bad_b : a < b;
                    });
  std::vector<WorstElement> worst;
  for (const Index e : std::span(order).first(n))
    worst.push_back({e, values[at(e)], element_centre(mesh, e)});
  return worst;
}

}  // namespace winslow
