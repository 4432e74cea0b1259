#include "core/quality/surface_distance.h"

#include <Eigen/Geometry>

#include "core/geometry/surface/triangulation.h"
#include "core/parallel/parallel_for.h"

namespace winslow {

namespace {

/// Distance from a triangle: from its plane if the foot lies inside, else from the nearest edge.
double distance(const Vec3& p, const std::array<Vec3, 3>& t) {
  const Vec3 area = (t[1] - t[0]).cross(t[2] - t[0]);
  const double size2 = area.squaredNorm();
  bool within = size2 > 0;
  for (std::size_t k = 0; k < 3 && within; ++k)
    within = area.dot((t[(k + 1) % 3] - t[k]).cross(p - t[k])) >= 0;
  if (within) return std::abs(area.dot(p - t[0])) / std::sqrt(size2);
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < 3; ++k)
    least = std::min(least, segment_distance<3>(p, t[k], t[(k + 1) % 3]));
  return least;
}

/// value(i) for each i < n.
template <typename Value>
std::vector<double> values_of(Index n, int threads, const Value& value) {
  constexpr Index block = 512;
  std::vector<double> values(at(n), 0.0);
  const auto measure = [&](Index begin, Index end) {
    for (Index i = begin; i < end; ++i) values[at(i)] = value(i);
  };
  parallel_for(threads, n, measure, block);
  return values;
}

/// The largest distance of the centres of the triangles of an element.
double middle_distance(const SpacePoints& x, std::span<const Index> nodes,
                       const SurfaceDistance& from) {
  double largest = 0;
  for (const auto& [a, b, c] : triangles_of(x, nodes))
    largest = std::max(largest, from.to((x[nodes[at(a)]] + x[nodes[at(b)]] + x[nodes[at(c)]]) / 3));
  return largest;
}

}  // namespace

SurfaceDistance::SurfaceDistance(const Mesh& mesh) {
  require_kind(*mesh.topology, MeshKind::surface, "deviation");
  const SpacePoints x(mesh.coordinates);
  std::vector<Box<3>> boxes;
  boxes.reserve(at(mesh.topology->element_count()));
  triangles_.reserve(boxes.capacity());
  const auto add = [&](const Triangle& triangle) {
    triangles_.push_back(triangle);
    boxes.push_back(Box<3>::around(triangle));
    around_.add(boxes.back());
  };
  for (Index e = 0; e < mesh.topology->element_count(); ++e) {
    const auto nodes = mesh.topology->element(e);
    for (const auto& [a, b, c] : triangles_of(x, nodes))
      add({x[nodes[at(a)]], x[nodes[at(b)]], x[nodes[at(c)]]});
  }
  tree_ = BoxTree<3>(boxes);
}

double SurfaceDistance::to(const Vec3& point) const {
  constexpr double near = 0.01;  // of the extent: a search within it is faster and mostly succeeds
  const auto to_triangle = [&](Index t) { return distance(point, triangles_[at(t)]); };
  auto found = tree_.nearest(point, near * extent(), to_triangle);
  if (!found) found = tree_.nearest(point, std::numeric_limits<double>::infinity(), to_triangle);
  return found ? found->distance : 0;
}

std::vector<double> node_distances(const Mesh& mesh, const SurfaceDistance& from, int threads) {
  const SpacePoints x(mesh.coordinates);
  return values_of(mesh.topology->node_count(), threads,
                   [&](Index node) { return mesh.topology->used(node) ? from.to(x[node]) : 0.0; });
}

double element_distance(const Mesh& mesh, Index element, const SurfaceDistance& from) {
  const SpacePoints x(mesh.coordinates);
  const auto nodes = mesh.topology->element(element);
  double largest = middle_distance(x, nodes, from);
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    const Vec3 a = x[nodes[k]], b = x[nodes[(k + 1) % nodes.size()]];
    largest = std::max({largest, from.to(a), from.to(0.5 * (a + b))});
  }
  return largest;
}

std::vector<double> element_distances(const Mesh& mesh, const SurfaceDistance& from, int threads) {
  const Topology& topology = *mesh.topology;
  const SpacePoints x(mesh.coordinates);
  const std::vector<double> of_nodes = node_distances(mesh, from, threads);
  const auto edges = topology.edges();
  const std::vector<double> of_edges =
      values_of(static_cast<Index>(edges.size()), threads, [&](Index k) {
        return from.to(0.5 * (x[edges[at(k)].nodes[0]] + x[edges[at(k)].nodes[1]]));
      });
  std::vector<double> values = values_of(topology.element_count(), threads, [&](Index e) {
    double largest = middle_distance(x, topology.element(e), from);
    for (const Index node : topology.element(e)) largest = std::max(largest, of_nodes[at(node)]);
    return largest;
  });
  for (std::size_t k = 0; k < edges.size(); ++k)
    for (const Index e : edges[k].elements)
      if (e >= 0) values[at(e)] = std::max(values[at(e)], of_edges[k]);
  return values;
}

namespace {

/// Enclosed volume; none unless the surface is closed.
std::optional<double> volume_of(const Mesh& mesh) {
  const auto is_border = [](const Topology::Edge& edge) { return edge.elements[1] < 0; };
  if (std::ranges::any_of(mesh.topology->edges(), is_border)) return std::nullopt;
  return enclosed_volume(mesh);
}

double largest_of(std::span<const double> values) {
  return values.empty() ? 0 : *std::ranges::max_element(values);
}

}  // namespace

double enclosed_volume(const Mesh& mesh) {
  const SpacePoints x(mesh.coordinates);
  const Vec3 origin = !mesh.coordinates.empty() ? Vec3(x[0]) : Vec3(0, 0, 0);
  double volume = 0;
  const auto add = [&](const Vec3& a, const Vec3& b, const Vec3& c) {
    volume += (a - origin).dot((b - origin).cross(c - origin)) / 6;
  };
  for (Index e = 0; e < mesh.topology->element_count(); ++e) {
    const auto nodes = mesh.topology->element(e);
    for (const auto& [a, b, c] : triangles_of(x, nodes))
      add(x[nodes[at(a)]], x[nodes[at(b)]], x[nodes[at(c)]]);
  }
  return volume;
}

SurfaceChange compare_surfaces(const Mesh& before, const SurfaceDistance& to_before,
                               const Mesh& after, std::span<const double> after_to_before,
                               int threads) {
  SurfaceChange change;
  change.extent = to_before.extent();
  change.from_before = largest_of(element_distances(before, SurfaceDistance(after), threads));
  change.from_after = largest_of(after_to_before);
  change.volume_before = volume_of(before);
  change.volume_after = volume_of(after);
  return change;
}

SurfaceChange compare_surfaces(const Mesh& before, const Mesh& after, int threads) {
  const SurfaceDistance to_before(before);
  return compare_surfaces(before, to_before, after, element_distances(after, to_before, threads),
                          threads);
}

}  // namespace winslow
