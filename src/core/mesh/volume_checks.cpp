#include "core/mesh/volume_checks.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <string>

#include "core/error.h"
#include "core/mesh/mesh_checks.h"
#include "core/parallel/parallel_for.h"
#include "core/search/box_tree.h"

namespace winslow {

namespace {

constexpr double near = 1e-9;  // of the size of a face

/// Is any corner's parallelepiped more than round-off?
bool has_volume(const SpacePoints& x, ElementType type, std::span<const Index> corners) {
  const ElementShape& shape = shape_of(type);
  double longest2 = 0;
  double largest3 = 0;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Face link = by_nodes(shape.links[k], corners);
    const Vec3 p = x[corners[k]];
    const Vec3 a = x[link[0]] - p, b = x[link[1]] - p, c = x[link[2]] - p;
    longest2 = std::max({longest2, a.squaredNorm(), b.squaredNorm(), c.squaredNorm()});
    largest3 = std::max(largest3, std::abs(a.dot(b.cross(c))));
  }
  constexpr double flat = 1e-15;
  return largest3 > flat * longest2 * std::sqrt(longest2);
}

/// Does p lie on the triangle, edges included, but not at a corner?
bool on_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 u = b - a, v = c - a, w = p - a;
  const Vec3 normal = u.cross(v);
  const double area = normal.norm();
  if (!(area > 0)) return false;
  const double size =
      std::sqrt(std::max({u.squaredNorm(), v.squaredNorm(), (c - b).squaredNorm()}));
  if (std::abs(w.dot(normal)) > near * size * area) return false;
  const double of_b = normal.dot(w.cross(v)) / (area * area);
  const double of_c = normal.dot(u.cross(w)) / (area * area);
  const double of_a = 1 - of_b - of_c;
  return std::min({of_a, of_b, of_c}) > -near && std::max({of_a, of_b, of_c}) < 1 - near;
}

bool on_face(const SpacePoints& x, const Face& face, const Vec3& p) {
  const Vec3 a = x[face[0]], b = x[face[1]], c = x[face[2]];
  if (on_triangle(p, a, b, c)) return true;
  return face.size() == 4 && on_triangle(p, a, c, x[face[3]]);
}

}  // namespace

void check_volumes(const Mesh& mesh) {
  const Topology& topology = *mesh.topology;
  const SpacePoints x(mesh.coordinates);
  parallel_for(0, topology.element_count(), [&](Index begin, Index end) {
    for (Index e = begin; e < end; ++e) {
      if (has_volume(x, topology.element_type(e), topology.element(e))) continue;
      throw MeshError(
          MeshEntity::element, e,
          "element " + std::to_string(e) + " has no volume (its corners lie in one plane)");
    }
  });
}

void check_boundary_faces(const Mesh& mesh) {
  const Topology& topology = *mesh.topology;
  const SpacePoints x(mesh.coordinates);
  const auto nodes = by_position(mesh.coordinates, boundary_nodes(topology));
  std::vector<Vec3> places;
  places.reserve(nodes.size());
  for (const Index node : nodes) places.push_back(x[node]);
  const BoxTree<3> tree(places);
  for (Index f = 0; f < topology.face_count(); ++f) {
    const Topology::SharedFace face = topology.face(f);
    if (face.elements[1] >= 0) continue;
    Box<3> box = Box<3>::empty();
    for (const Index node : face.nodes) box.add(x[node]);
    const Vec3 slack = Vec3::Constant(near * box.size().norm());
    auto first = static_cast<Index>(nodes.size());
    tree.overlapping({box.min - slack, box.max + slack}, [&](Index k) {
      const Index node = nodes[static_cast<std::size_t>(k)];
      const bool corner = std::find(face.nodes.begin(), face.nodes.end(), node) != face.nodes.end();
      if (k < first && !corner && on_face(x, face.nodes, x[node])) first = k;
    });
    if (first == static_cast<Index>(nodes.size())) continue;
    const Index node = nodes[static_cast<std::size_t>(first)];
    throw MeshError(MeshEntity::node, node,
                    "node " + std::to_string(node) + " lies inside the face with " +
                        nodes_text(face.nodes) + " (hanging node)");
  }
}

void check_matching_faces(const Topology& topology) {
  for (Index f = 0; f < topology.face_count(); ++f) {
    const Topology::SharedFace face = topology.face(f);
    if (face.elements[1] >= 0 || face.nodes.size() != 4) continue;
    for (std::size_t k = 0; k < 4; ++k) {
      const Face half(face.nodes[k], face.nodes[(k + 1) % 4], face.nodes[(k + 2) % 4]);
      const auto triangle = topology.find_face(half);
      if (!triangle) continue;
      const Index e = topology.face(*triangle).elements[0];
      throw MeshError(MeshEntity::element, e,
                      "the triangle with " + nodes_text(half) + " of element " + std::to_string(e) +
                          " covers half of a quadrilateral of element " +
                          std::to_string(face.elements[0]) +
                          ", expected neighbours to share a whole face");
    }
  }
}

}  // namespace winslow
