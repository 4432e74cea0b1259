#include "core/geometry/element_normals.h"

#include <Eigen/Geometry>

#include "core/parallel/parallel_for.h"

namespace winslow {

namespace {

/// Block size of loops over feet, each of which may need a search.
constexpr Index search_block = 512;

}  // namespace

Vec3 doubled_area_vector(const Points<3>& x, std::span<const Index> element) {
  const Vec3 a = x[element[0]], b = x[element[1]], c = x[element[2]];
  if (element.size() == 3) return (b - a).cross(c - a);
  return (c - a).cross(x[element[3]] - b);
}

/// of_node: 1 if elements face along the normal of the frame of the node, -1 if they face against
/// it, 0 for a node without a normal. given: normals of the elements in the given mesh.
struct ElementNormals::Sides {
  std::vector<signed char> of_node;
  std::vector<Vec3> given;
};

ElementNormals::ElementNormals(std::shared_ptr<const Topology> topology, const Coordinates& given,
                               const SlidingBoundary& boundary)
    : topology_(std::move(topology)), geometry_(boundary.geometry) {
  const SpacePoints x(given);
  auto sides = std::make_shared<Sides>();
  sides->of_node.assign(at(topology_->node_count()), 0);
  for (Index e = 0; e < topology_->element_count(); ++e) {
    const Vec3 area = doubled_area_vector(x, topology_->element(e));
    const double length = area.norm();
    sides->given.push_back(length > 0 ? Vec3(area / length) : Vec3::UnitZ());
  }
  sides_ = sides;
  for (const SlidingPart& part : boundary.parts) {
    std::vector<Foot> feet(part.nodes.size());
    const auto find = [&](Index begin, Index end) {
      for (std::size_t i = at(begin); i < at(end); ++i)
        feet[i] = geometry_->foot(part.nodes[i], x[part.nodes[i]]);
    };
    parallel_for(0, static_cast<Index>(feet.size()), find, search_block);
    // Even if some elements are turned over, most area faces to the right side.
    double area = 0;
    std::vector<Index> on_surface;
    for (std::size_t i = 0; i < feet.size(); ++i) {
      const Foot& foot = feet[i];
      if (foot.frame.count() != 2) continue;
      on_surface.push_back(part.nodes[i]);
      const Vec3 normal = foot.frame[0].cross(foot.frame[1]);
      for (const Index e : topology_->star(part.nodes[i]))
        area += normal.dot(doubled_area_vector(x, topology_->element(e)));
    }
    for (const Index node : on_surface) sides->of_node[at(node)] = area < 0 ? -1 : 1;
  }
}

ElementNormals ElementNormals::with_geometry(
    std::shared_ptr<const SlidingGeometry> geometry) const {
  ElementNormals other = *this;
  other.geometry_ = std::move(geometry);
  return other;
}

Vec3 ElementNormals::node_normal(Index node, const Vec3& point) const {
  const double side = sides_->of_node[at(node)];
  if (side == 0) return Vec3::Zero();
  const Foot foot = geometry_->foot(node, point);
  return side * foot.frame[0].cross(foot.frame[1]);
}

std::vector<Vec3> ElementNormals::of_elements(const Coordinates& coordinates, int threads) const {
  const SpacePoints x(coordinates);
  std::vector<Vec3> of_nodes(at(topology_->node_count()));
  parallel_for(
      threads, topology_->node_count(),
      [&](Index begin, Index end) {
        for (Index node = begin; node < end; ++node)
          of_nodes[at(node)] = node_normal(node, x[node]);
      },
      search_block);
  std::vector<Vec3> normals(at(topology_->element_count()));
  parallel_for(threads, topology_->element_count(), [&](Index begin, Index end) {
    for (Index e = begin; e < end; ++e) {
      Vec3 sum = Vec3::Zero();
      for (const Index node : topology_->element(e)) sum += of_nodes[at(node)];
      normals[at(e)] = from_nodes(e, sum);
    }
  });
  return normals;
}

Vec3 ElementNormals::of_element(Index element, const Coordinates& coordinates) const {
  const SpacePoints x(coordinates);
  Vec3 sum = Vec3::Zero();
  for (const Index node : topology_->element(element)) sum += node_normal(node, x[node]);
  return from_nodes(element, sum);
}

/// The normal of an element whose nodes have normals with this sum.
Vec3 ElementNormals::from_nodes(Index element, const Vec3& sum) const {
  constexpr double cancelled = 0.1;  // below it normals of opposite sides of a body cancel
  const double length = sum.norm();
  if (!(length > cancelled)) return sides_->given[at(element)];
  return sum / length;
}

}  // namespace winslow
