#include "core/quality/quality.h"

#include <utility>

#include "core/error.h"
#include "core/geometry/element_normals.h"
#include "core/mesh/polygon.h"
#include "core/parallel/parallel_for.h"
#include "core/quality/corner_kernel.h"

namespace winslow {

namespace {

/// The corners of a triangle or a quadrilateral, in the order of its nodes.
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
  operator PlaneElement() const { return {span()}; }  // NOLINT(google-explicit-constructor)
  /// Whether any corner is inverted. Round-off may give the corners of a flat triangle different
  /// signs.
  bool inverted() const {
    return std::ranges::any_of(span(), [](const Corner& corner) { return corner.inverted(); });
  }

 private:
  std::array<Corner, 4> corners_;
  std::size_t count_;
};

/// The corners of a polygon that are not flat.
class PolygonElement {
 public:
  PolygonElement(const Coordinates& x, const ElementShape& shape, std::span<const Index> element)
      : places_(places_of(x, element)), area_(0.5 * signed_area2(x, element)) {
    for (std::size_t k = 0; k < shape.corner_triangles.size(); ++k) {
      const auto& [a, b, c] = shape.corner_triangles[k];
      const Corner corner(places_[at(a)], places_[at(b)], places_[at(c)]);
      corner_inverted_ |= corner.inverted();
      if (k >= shape.side_edges.size()) continue;
      const auto [next, previous] = shape.side_edges[k];
      corners_.push_back(next == 1 && previous == 1 ? corner : corner.stretched(next, previous));
    }
  }
  std::span<const Corner> span() const { return corners_; }
  operator PlaneElement() const {  // NOLINT(google-explicit-constructor)
    return {.corners = corners_, .polygon_area = area_, .polygon = true};
  }
  bool inverted() const { return corner_inverted_ || !(area_ > 0) || !is_simple(places_); }

 private:
  std::vector<Vec2> places_;
  double area_;
  std::vector<Corner> corners_;
  bool corner_inverted_ = false;
};

/// For a plane mesh or a surface mesh. normals: reference normals; empty: there are none.
ElementCorners corners_of(const Topology& topology, const Coordinates& x,
                          std::span<const Vec3> normals, Index e) {
  const auto element = topology.element(e);
  if (!is_surface(topology)) return {x, element};
  const SpacePoints points(x);
  return {points, element, normals.empty() ? doubled_area_vector(points, element) : normals[at(e)]};
}

PolygonElement polygon_corners(const Topology& topology, const Coordinates& x, Index e) {
  return {x, topology.shape(e), topology.element(e)};
}

/// Calls use(element) with the ElementCorners, the PolygonElement or the VolumeElement of an
/// element.
template <class Use>
auto with_element(const Mesh& mesh, std::span<const Vec3> normals, Index e, const Use& use) {
  const Topology& topology = *mesh.topology;
  if (topology.element_type(e) == ElementType::polygon)
    return use(polygon_corners(topology, mesh.coordinates, e));
  if (topology.kind() != MeshKind::volume)
    return use(corners_of(topology, mesh.coordinates, normals, e));
  return use(VolumeElement(mesh.coordinates, topology.shape(e), topology.element(e)));
}

std::span<const Corner> corners_in(const ElementCorners& element) { return element.span(); }
std::span<const Corner> corners_in(const PolygonElement& element) { return element.span(); }
std::span<const Corner> corners_in(const VolumeElement&) { return {}; }

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

/// Fills in the values of metrics that depend on neighbours (MetricInfo::of_cell).
/// values: of each metric, #elements.
void measure_cells(const Mesh& mesh, std::span<const MetricInfo* const> infos,
                   std::vector<std::vector<double>>& values, int threads) {
  if (std::ranges::none_of(infos, [](const MetricInfo* info) { return info->of_cell != nullptr; }))
    return;
  const CellFaces faces = cell_faces(*mesh.topology);
  const FiniteVolumes cells(faces, mesh.coordinates, threads);
  parallel_for(threads, faces.cell_count(), [&](Index begin, Index end) {
    for (std::size_t m = 0; m < infos.size(); ++m) {
      if (!infos[m]->of_cell) continue;
      for (Index e = begin; e < end; ++e) values[m][at(e)] = (cells.*infos[m]->of_cell)(e);
    }
  });
}

std::vector<const MetricInfo*> infos_of(std::span<const Metric> metrics, int cell_dimension) {
  std::vector<const MetricInfo*> infos;
  for (const Metric metric : metrics) infos.push_back(&metric_info(metric, cell_dimension));
  return infos;
}

/// Values of the reported metrics, in their order.
struct Values {
  Values(const Mesh& mesh, std::span<const Vec3> normals, int threads);

  std::vector<std::vector<double>> of_elements;  ///< #elements each
  /// #corners each, NaN of the flat corners of polygons; empty where there are none.
  std::vector<std::vector<double>> of_corners;
  std::vector<char> inverted;  ///< #elements
};

Values::Values(const Mesh& mesh, std::span<const Vec3> normals, int threads) {
  const Topology& topology = *mesh.topology;
  const int dimension = topology.cell_dimension();
  const auto infos = infos_of(reported_metrics(dimension), dimension);
  const auto elements = at(topology.element_count());
  for (const MetricInfo* info : infos) {
    of_elements.emplace_back(elements);
    of_corners.emplace_back(info->of_corner ? topology.elements().values.size() : 0);
  }
  inverted.resize(elements);
  parallel_for(threads, topology.element_count(), [&](Index begin, Index end) {
    for (Index e = begin; e < end; ++e) {
      const auto first = at(topology.elements().offsets[at(e)]);
      with_element(mesh, normals, e, [&](const auto& element) {
        inverted[at(e)] = element.inverted();
        const auto corners = corners_in(element);
        for (std::size_t m = 0; m < infos.size(); ++m) {
          if (infos[m]->of_cell) continue;
          of_elements[m][at(e)] = infos[m]->of(element);
          if (!infos[m]->of_corner) continue;
          for (std::size_t k = 0; k < corners.size(); ++k)
            of_corners[m][first + k] = (corners[k].*infos[m]->of_corner)();
          for (std::size_t k = first + corners.size();
               k < at(topology.elements().offsets[at(e) + 1]); ++k)
            of_corners[m][k] = std::numeric_limits<double>::quiet_NaN();
        }
      });
    }
  });
  measure_cells(mesh, infos, of_elements, threads);
}

/// Counts the elements that no smoothing can change.
void count_fixed(const Topology& topology, const Values& values, QualityReport& report) {
  for (Index e = 0; e < topology.element_count(); ++e) {
    if (!all_on_boundary(topology, e)) continue;
    ++report.all_on_boundary;
    if (values.inverted[at(e)]) ++report.all_on_boundary_inverted;
  }
}

/// As statistics_of(), but of no values NaN: not measured.
Statistics measured(std::span<const double> values) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  return values.empty() ? Statistics{none, none, none} : statistics_of(values);
}

}  // namespace

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

bool all_on_boundary(const Topology& topology, Index e) {
  return std::ranges::all_of(topology.element(e),
                             [&](Index node) { return topology.on_boundary(node); });
}

const QualityReport::PerMetric& QualityReport::of(Metric metric) const& {
  const auto& reported = reported_metrics(cell_dimension);
  const std::size_t m = index_of(reported, metric);
  if (m == reported.size())
    throw UsageError("the quality report has no statistics of the " +
                     std::string(metric_name(metric)));
  return metrics[m];
}

QualityReport::PerMetric QualityReport::of(Metric metric) && {
  return std::as_const(*this).of(metric);
}

namespace {

/// The finite values of the elements of a volume mesh that have a node inside it.
std::vector<double> movable_values(const Topology& topology, const std::vector<double>& all) {
  std::vector<double> movable;
  for (Index e = 0; e < topology.element_count(); ++e)
    if (std::isfinite(all[at(e)]) && !all_on_boundary(topology, e)) movable.push_back(all[at(e)]);
  return movable;
}

/// some_fixed: the mesh has elements that no smoothing can change.
QualityReport::PerMetric describe_metric(const Mesh& mesh, const Values& values, std::size_t m,
                                         bool some_fixed, const QualityOptions& options) {
  const int dimension = mesh.topology->cell_dimension();
  const MetricInfo& info = metric_info(reported_metrics(dimension)[m], dimension);
  QualityReport::PerMetric part;
  const auto& all = values.of_elements[m];
  part.worst = worst_elements(mesh, all, info.field, options.worst);
  std::vector<double> counted = info.of_corner ? values.of_corners[m] : all;
  if (!info.of_corner || mesh.topology->has_polygons())
    std::erase_if(counted, [](double v) { return !std::isfinite(v); });
  part.statistics = measured(counted);
  part.movable = some_fixed ? measured(movable_values(*mesh.topology, all)) : part.statistics;
  const Statistics range = statistics_of(counted);
  const double low = info.field.larger_is_better ? std::min(0.0, range.min) : info.best;
  const double high =
      info.field.larger_is_better || counted.empty() ? info.best : part.statistics.max;
  part.histogram = histogram_of(counted, low, high, options.histogram_bins);
  return part;
}

}  // namespace

QualityReport measure_quality(const Mesh& mesh, const QualityOptions& options) {
  const Values values(mesh, options.normals, options.threads);
  QualityReport report;
  report.cell_dimension = mesh.topology->cell_dimension();
  report.space_dimension = mesh.topology->space_dimension();
  if (mesh.topology->kind() == MeshKind::volume) count_fixed(*mesh.topology, values, report);
  report.folds = find_folds(mesh);
  report.elements = mesh.topology->element_count();
  constexpr std::size_t listed = 100;
  for (Index e = 0; e < report.elements; ++e) {
    if (!values.inverted[at(e)]) continue;
    ++report.inverted;
    if (report.inverted_elements.size() < listed) report.inverted_elements.push_back(e);
  }
  const auto metrics = static_cast<Index>(values.of_elements.size());
  report.metrics.resize(at(metrics));
  const auto describe = [&](Index m, Index /*end*/) {
    report.metrics[at(m)] =
        describe_metric(mesh, values, at(m), report.all_on_boundary > 0, options);
  };
  parallel_for(options.threads, metrics, describe, 1);
  if (!report.has_walls()) return report;
  WallSurvey survey(mesh, options.threads);
  report.walls = survey.report();
  for (const WallField field : all_wall_fields()) {
    report.worst_at_walls.push_back(
        options.worst > 0 ? worst_elements(mesh, survey.element_values(field, options.before),
                                           wall_field_info(field), options.worst)
                          : std::vector<WorstElement>());
  }
  return report;
}

double element_value(const Mesh& mesh, Index e, Metric metric, std::span<const Vec3> normals) {
  const MetricInfo& info = metric_info(metric, mesh.topology->cell_dimension());
  if (info.of_cell) {
    const CellSurroundings near = cell_surroundings(*mesh.topology, e);
    return (FiniteVolumes(near.faces, mesh.coordinates, 1).*info.of_cell)(near.cell);
  }
  return with_element(mesh, normals, e, [&](const auto& element) { return info.of(element); });
}

std::vector<double> element_values(const Mesh& mesh, Metric metric, std::span<const Vec3> normals) {
  return std::move(element_values(mesh, {&metric, 1}, normals).front());
}

std::vector<std::vector<double>> element_values(const Mesh& mesh, std::span<const Metric> metrics,
                                                std::span<const Vec3> normals, int threads) {
  const auto infos = infos_of(metrics, mesh.topology->cell_dimension());
  const Index elements = mesh.topology->element_count();
  std::vector<std::vector<double>> values(metrics.size(), std::vector<double>(at(elements)));
  for (std::size_t m = 0; m < infos.size(); ++m) {
    if (infos[m]->of_cell) continue;
    parallel_for(threads, elements, [&](Index begin, Index end) {
      for (Index e = begin; e < end; ++e)
        values[m][at(e)] = element_value(mesh, e, metrics[m], normals);
    });
  }
  measure_cells(mesh, infos, values, threads);
  return values;
}

Index worst_element(const Mesh& mesh, Metric metric) {
  const std::vector<double> values = element_values(mesh, metric);
  const FieldInfo& info = metric_info(metric, mesh.topology->cell_dimension()).field;
  const auto worst =
      info.larger_is_better ? std::ranges::min_element(values) : std::ranges::max_element(values);
  return static_cast<Index>(worst - values.begin());
}

namespace {

/// Validity of all elements. of_block(begin, end): that of a block of elements.
template <typename OfBlock>
Validity check_blocks(Index n, int threads, const OfBlock& of_block) {
  std::vector<Validity> blocks(at((n + parallel_block - 1) / parallel_block), Validity{0, 1.0});
  parallel_for(threads, n, [&](Index begin, Index end) {
    blocks[at(begin / parallel_block)] = of_block(begin, end);
  });
  Validity total{0, 1.0};
  for (const Validity& v : blocks) {
    total.inverted += v.inverted;
    total.min_sine = std::min(total.min_sine, v.min_sine);
  }
  return total;
}

/// The same, element by element: add(element, sum) adds one element to the sum.
template <typename Add>
Validity check_elements(Index n, int threads, const Add& add) {
  return check_blocks(n, threads, [&](Index begin, Index end) {
    Validity sum{0, 1.0};
    for (Index e = begin; e < end; ++e) add(e, sum);
    return sum;
  });
}

Validity check_volume(const Topology& topology, const Coordinates& coordinates, int threads) {
  return check_elements(topology.element_count(), threads, [&](Index e, Validity& sum) {
    const VolumeElement element(coordinates, topology.shape(e), topology.element(e));
    sum.inverted += element.inverted() ? 1 : 0;
    if (!all_on_boundary(topology, e))
      sum.min_sine = std::min(sum.min_sine, element.scaled_jacobian());
  });
}

Validity check_surface(const Topology& topology, const Coordinates& coordinates,
                       std::span<const Vec3> normals, int threads) {
  return check_elements(topology.element_count(), threads, [&](Index e, Validity& sum) {
    const ElementCorners corners = corners_of(topology, coordinates, normals, e);
    sum.inverted += corners.inverted() ? 1 : 0;
    for (const Corner& corner : corners.span())
      sum.min_sine = std::min(sum.min_sine, corner.sine());
  });
}

Validity check_polygons(const Topology& topology, const Coordinates& coordinates, int threads) {
  return check_elements(topology.element_count(), threads, [&](Index e, Validity& sum) {
    const auto add = [&](const auto& corners) {
      sum.inverted += corners.inverted() ? 1 : 0;
      for (const Corner& corner : corners.span())
        sum.min_sine = std::min(sum.min_sine, corner.sine());
    };
    if (topology.element_type(e) == ElementType::polygon)
      add(polygon_corners(topology, coordinates, e));
    else
      add(corners_of(topology, coordinates, {}, e));
  });
}

Validity check_plane(const Topology& topology, const Coordinates& coordinates, int threads) {
  if (topology.has_polygons()) return check_polygons(topology, coordinates, threads);
  const CornerData data{coordinates.values().data(), topology.elements().offsets.data(),
                        topology.elements().values.data()};
  const CornerKernel avx2 = avx2_corner_kernel();
  const CornerKernel summarise = avx2 ? avx2 : portable_corner_kernel();
  return check_blocks(topology.element_count(), threads, [&](Index begin, Index end) {
    const CornerSummary block = summarise(data, begin, end);
    return Validity{block.inverted, block.min_sine};
  });
}

}  // namespace

bool is_inverted(const Topology& topology, const Coordinates& coordinates, Index e) {
  if (topology.kind() == MeshKind::volume)
    return VolumeElement(coordinates, topology.shape(e), topology.element(e)).inverted();
  if (topology.element_type(e) == ElementType::polygon)
    return polygon_corners(topology, coordinates, e).inverted();
  return corners_of(topology, coordinates, {}, e).inverted();
}

Validity check_validity(const Topology& topology, const Coordinates& coordinates, int threads,
                        std::span<const Vec3> normals) {
  coordinates.require_dimension(topology.space_dimension());
  switch (topology.kind()) {
    case MeshKind::volume:
      return check_volume(topology, coordinates, threads);
    case MeshKind::surface:
      return check_surface(topology, coordinates, normals, threads);
    case MeshKind::plane:
      break;
  }
  return check_plane(topology, coordinates, threads);
}

namespace {

/// Larger for worse values.
double badness(const FieldInfo& field, double value) {
  if (field.one_is_best) return std::abs(std::log(value));
  return field.larger_is_better ? -value : value;
}

}  // namespace

Vec3 element_centre(const Mesh& mesh, Index element) {
  Vec3 sum(0, 0, 0);
  const auto nodes = mesh.topology->element(element);
  for (const Index node : nodes) sum += place_of(mesh.coordinates, node);
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
