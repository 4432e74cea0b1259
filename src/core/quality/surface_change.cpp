#include "core/quality/surface_change.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "core/error.h"
#include "core/parallel/parallel_for.h"
#include "core/search/box_tree.h"

namespace winslow {

namespace {

using Triangle = std::array<Vec3, 3>;

/// visit(corners) for each triangle of an element.
template <typename Visit>
void for_each_triangle(const SpacePoints& x, std::span<const Index> nodes, const Visit& visit) {
  const Vec3 a = x[nodes[0]], b = x[nodes[1]], c = x[nodes[2]];
  if (nodes.size() == 3) return visit(Triangle{a, b, c});
  const Vec3 d = x[nodes[3]];
  if ((c - a).squaredNorm() <= (d - b).squaredNorm()) {
    visit(Triangle{a, b, c});
    visit(Triangle{a, c, d});
  } else {
    visit(Triangle{a, b, d});
    visit(Triangle{b, c, d});
  }
}

double squared_distance(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 along = b - a;
  const double length2 = along.squaredNorm();
  const double t = length2 > 0 ? std::clamp(along.dot(p - a) / length2, 0.0, 1.0) : 0;
  return (p - a - t * along).squaredNorm();
}

/// To the triangle: to its plane where the foot lies within, else to the nearest edge.
double distance(const Vec3& p, const Triangle& t) {
  const Vec3 area = (t[1] - t[0]).cross(t[2] - t[0]);
  const double size2 = area.squaredNorm();
  bool within = size2 > 0;
  for (std::size_t k = 0; k < 3 && within; ++k)
    within = area.dot((t[(k + 1) % 3] - t[k]).cross(p - t[k])) >= 0;
  if (within) return std::abs(area.dot(p - t[0])) / std::sqrt(size2);
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < 3; ++k)
    least = std::min(least, squared_distance(p, t[k], t[(k + 1) % 3]));
  return std::sqrt(least);
}

class Triangles {
 public:
  explicit Triangles(const Mesh& mesh) {
    const SpacePoints x(mesh.coordinates);
    std::vector<Box<3>> boxes;
    for (Index e = 0; e < mesh.topology->element_count(); ++e) {
      for_each_triangle(x, mesh.topology->element(e), [&](const Triangle& triangle) {
        triangles_.push_back(triangle);
        Box<3> box = Box<3>::empty();
        for (const Vec3& corner : triangle) box.add(corner);
        boxes.push_back(box);
        around_.add(box);
      });
    }
    tree_ = BoxTree<3>(boxes);
  }

  double extent() const { return around_.size().norm(); }

  /// To the nearest triangle. near: a length that is mostly larger.
  double distance_to(const Vec3& point, double near) const {
    const auto to = [&](Index t) { return distance(point, triangles_[at(t)]); };
    auto found = tree_.nearest(point, near, to);
    if (!found) found = tree_.nearest(point, std::numeric_limits<double>::infinity(), to);
    return found ? found->distance : 0;
  }

 private:
  std::vector<Triangle> triangles_;
  Box<3> around_ = Box<3>::empty();
  BoxTree<3> tree_;
};

/// Nodes, middles of edges, middles of elements.
std::vector<Vec3> samples(const Mesh& mesh) {
  const SpacePoints x(mesh.coordinates);
  const Topology& topology = *mesh.topology;
  std::vector<Vec3> places;
  for (Index node = 0; node < topology.node_count(); ++node)
    if (topology.used(node)) places.push_back(x[node]);
  for (const auto& edge : topology.edges())
    places.push_back(0.5 * (x[edge.nodes[0]] + x[edge.nodes[1]]));
  for (Index e = 0; e < topology.element_count(); ++e)
    for_each_triangle(x, topology.element(e), [&](const Triangle& triangle) {
      places.push_back((triangle[0] + triangle[1] + triangle[2]) / 3);
    });
  return places;
}

double largest_distance(const std::vector<Vec3>& places, const Triangles& surface, int threads) {
  constexpr Index block = 512;
  const auto count = static_cast<Index>(places.size());
  const double near = 0.01 * surface.extent();
  std::vector<double> largest(at((count + block - 1) / block), 0.0);
  const auto measure = [&](Index begin, Index end) {
    double& of_block = largest[at(begin / block)];
    for (auto i = at(begin); i < at(end); ++i)
      of_block = std::max(of_block, surface.distance_to(places[i], near));
  };
  parallel_for(threads, count, measure, block);
  return largest.empty() ? 0 : *std::ranges::max_element(largest);
}

bool is_closed(const Topology& topology) {
  return std::ranges::none_of(topology.edges(),
                              [](const Topology::Edge& edge) { return edge.elements[1] < 0; });
}

}  // namespace

double enclosed_volume(const Mesh& mesh) {
  const SpacePoints x(mesh.coordinates);
  const Vec3 origin = !mesh.coordinates.empty() ? Vec3(x[0]) : Vec3(0, 0, 0);
  double volume = 0;
  for (Index e = 0; e < mesh.topology->element_count(); ++e)
    for_each_triangle(x, mesh.topology->element(e), [&](const Triangle& t) {
      volume += (t[0] - origin).dot((t[1] - origin).cross(t[2] - origin)) / 6;
    });
  return volume;
}

SurfaceChange compare_surfaces(const Mesh& before, const Mesh& after, int threads) {
  for (const Mesh* mesh : {&before, &after})
    if (!is_surface(*mesh->topology))
      throw UsageError("deviation: only for a surface mesh, and this is a " +
                       std::string(mesh_kind(*mesh->topology)));
  const Triangles first(before), second(after);
  SurfaceChange change;
  change.extent = first.extent();
  change.from_before = largest_distance(samples(before), second, threads);
  change.from_after = largest_distance(samples(after), first, threads);
  if (is_closed(*before.topology)) change.volume_before = enclosed_volume(before);
  if (is_closed(*after.topology)) change.volume_after = enclosed_volume(after);
  return change;
}

}  // namespace winslow
