#include "core/mesh/mesh_checks.h"

#include <Eigen/Geometry>
#include <utility>

#include "core/error.h"
#include "core/parallel/parallel_for.h"
#include "core/search/box_tree.h"

namespace winslow {

namespace {

/// Area of the parallelogram between two vectors.
double area(const Vec2& a, const Vec2& b) { return std::abs(a.x() * b.y() - a.y() * b.x()); }
double area(const Vec3& a, const Vec3& b) { return a.cross(b).norm(); }

template <int D>
bool has_area(const Points<D>& x, std::span<const Index> corners) {
  const std::size_t n = corners.size();
  double longest2 = 0;
  double largest2 = 0;
  for (std::size_t k = 0; k < n; ++k) {
    const Vec<D> p = x[corners[k]];
    const Vec<D> a = x[corners[(k + 1) % n]] - p;
    const Vec<D> b = x[corners[(k + n - 1) % n]] - p;
    longest2 = std::max(longest2, a.squaredNorm());
    largest2 = std::max(largest2, area(a, b));
  }
  // Round-off in the coordinates themselves leaves about this much of an exactly flat element.
  constexpr double flat = 1e-15;
  return largest2 > flat * longest2;
}

template <int D>
void check_areas(const Mesh& mesh) {
  const Points<D> x(mesh.coordinates);
  for (Index e = 0; e < mesh.topology->element_count(); ++e) {
    if (!has_area<D>(x, mesh.topology->element(e))) {
      throw MeshError(
          MeshEntity::element, e,
          "element " + std::to_string(e) + " has no area (its corners lie on one line)");
    }
  }
}

/// Finds, of some nodes in the order of their positions, the first that lies inside an edge.
template <int D>
class HangingNodes {
 public:
  HangingNodes(const Coordinates& coordinates, std::vector<Index> candidates)
      : x_(coordinates), nodes_(by_position(coordinates, std::move(candidates))) {
    std::vector<Vec<D>> places;
    places.reserve(nodes_.size());
    for (const Index node : nodes_) places.push_back(x_[node]);
    tree_ = BoxTree<D>(places);
  }

  std::optional<Index> first_inside(std::span<const Index> edge) const {
    const Vec<D> a = x_[edge[0]];
    const Vec<D> d = x_[edge[1]] - a;
    const double length2 = d.squaredNorm();
    const auto inside = [&](Index node) {
      if (node == edge[0] || node == edge[1]) return false;
      const Vec<D> p = x_[node] - a;
      const double along = p.dot(d) / length2;
      return along > near && along < 1 - near && area(p, d) < near * length2;
    };
    Box<D> box{a, a};
    box.add(a + d);
    const Vec<D> slack = Vec<D>::Constant(near * std::sqrt(length2));
    auto first = static_cast<Index>(nodes_.size());
    tree_.overlapping({box.min - slack, box.max + slack}, [&](Index k) {
      if (k < first && inside(nodes_[at(k)])) first = k;
    });
    if (first == static_cast<Index>(nodes_.size())) return std::nullopt;
    return nodes_[at(first)];
  }

 private:
  static constexpr double near = 1e-9;  // of the edge's length

  Points<D> x_;
  std::vector<Index> nodes_;
  BoxTree<D> tree_;  // of nodes_
};

/// Nodes inside boundary edges of a plane or surface mesh.
template <int D>
void check_edges(const Mesh& mesh) {
  const HangingNodes<D> hanging(mesh.coordinates, boundary_nodes(*mesh.topology));
  for (const auto& edge : mesh.topology->edges()) {
    if (edge.elements[1] >= 0) continue;
    const auto node = hanging.first_inside(edge.nodes);
    if (!node) continue;
    throw MeshError(MeshEntity::node, *node,
                    "node " + std::to_string(*node) + " lies inside the edge between nodes " +
                        std::to_string(edge.nodes[0]) + " and " + std::to_string(edge.nodes[1]) +
                        " (hanging node)");
  }
}

template <int D>
void sort_by_position(const Points<D>& x, std::vector<Index>& nodes) {
  std::sort(nodes.begin(), nodes.end(), [&](Index a, Index b) {
    const Vec<D> p = x[a], q = x[b];
    for (int k = 0; k < D; ++k) {
      if (p[k] != q[k]) return p[k] < q[k];
    }
    return a < b;
  });
}

/// Calls visit(first, other) for each node that lies where the first of its place does; nodes in
/// the order of their positions.
template <int D, class Visit>
void for_duplicates(const Points<D>& x, std::span<const Index> sorted, Visit visit) {
  std::size_t first = 0;
  for (std::size_t k = 1; k < sorted.size(); ++k) {
    if (x[sorted[first]] != x[sorted[k]]) {
      first = k;
    } else {
      visit(sorted[first], sorted[k]);
    }
  }
}

[[noreturn]] void refuse_duplicate(Index first, Index second) {
  throw MeshError(MeshEntity::node, second,
                  "node " + std::to_string(second) + " lies exactly where node " +
                      std::to_string(first) + " does (duplicate node)");
}

/// An edge or face without extent would pass for a crack.
template <int D>
void check_corners_apart(const Mesh& mesh, const std::vector<bool>& shared_place) {
  const Points<D> x(mesh.coordinates);
  for (Index e = 0; e < mesh.topology->element_count(); ++e) {
    const auto corners = mesh.topology->element(e);
    for (std::size_t k = 1; k < corners.size(); ++k) {
      if (!shared_place[at(corners[k])]) continue;
      for (std::size_t j = 0; j < k; ++j) {
        if (x[corners[j]] == x[corners[k]])
          refuse_duplicate(std::min(corners[j], corners[k]), std::max(corners[j], corners[k]));
      }
    }
  }
}

template <int D>
Index count_duplicates(const Mesh& mesh, std::span<const Index> sorted) {
  std::vector<bool> on_boundary(at(mesh.topology->node_count()), false);
  for (const Index node : boundary_nodes(*mesh.topology)) on_boundary[at(node)] = true;
  std::vector<bool> shared_place(on_boundary.size(), false);
  Index count = 0;
  for_duplicates(Points<D>(mesh.coordinates), sorted, [&](Index first, Index second) {
    if (!on_boundary[at(first)] || !on_boundary[at(second)]) refuse_duplicate(first, second);
    shared_place[at(first)] = shared_place[at(second)] = true;
    ++count;
  });
  if (count > 0) check_corners_apart<D>(mesh, shared_place);
  return count;
}

}  // namespace

std::vector<Index> by_position(const Coordinates& coordinates, std::vector<Index> nodes) {
  if (coordinates.dimension() == 2) {
    sort_by_position(PlanePoints(coordinates), nodes);
  } else {
    sort_by_position(SpacePoints(coordinates), nodes);
  }
  return nodes;
}

std::vector<Index> boundary_nodes(const Topology& topology) {
  std::vector<bool> on_boundary(at(topology.node_count()), false);
  for (Index f = 0; f < topology.face_count(); ++f) {
    const Topology::SharedFace face = topology.face(f);
    if (face.elements[1] >= 0) continue;
    for (const Index node : face.nodes) on_boundary[at(node)] = true;
  }
  std::vector<Index> nodes;
  for (Index i = 0; i < topology.node_count(); ++i) {
    if (on_boundary[at(i)]) nodes.push_back(i);
  }
  return nodes;
}

void check_finite(const Coordinates& coordinates) {
  const auto values = coordinates.values();
  const auto it = std::find_if_not(values.begin(), values.end(),
                                   [](double value) { return std::isfinite(value); });
  if (it == values.end()) return;
  const auto node = static_cast<Index>((it - values.begin()) / coordinates.dimension());
  throw MeshError(MeshEntity::node, node,
                  "node " + std::to_string(node) + " has a coordinate that is not a finite number");
}

void check_isolated(const Topology& topology) {
  if (topology.element_count() < 2) return;
  std::vector<bool> joined(at(topology.element_count()), false);
  for (Index f = 0; f < topology.face_count(); ++f) {
    const auto elements = topology.face(f).elements;
    if (elements[1] < 0) continue;
    for (const Index e : elements) joined[at(e)] = true;
  }
  const auto it = std::find(joined.begin(), joined.end(), false);
  if (it == joined.end()) return;
  const auto e = static_cast<Index>(it - joined.begin());
  throw MeshError(MeshEntity::element, e,
                  "element " + std::to_string(e) + " shares no " +
                      (topology.cell_dimension() == 2 ? "edge" : "face") +
                      " with any other (isolated)");
}

Index check_duplicates(const Mesh& mesh) {
  std::vector<Index> used;
  for (Index i = 0; i < mesh.topology->node_count(); ++i) {
    if (mesh.topology->used(i)) used.push_back(i);
  }
  const auto sorted = by_position(mesh.coordinates, std::move(used));
  return mesh.coordinates.dimension() == 2 ? count_duplicates<2>(mesh, sorted)
                                           : count_duplicates<3>(mesh, sorted);
}

void check_extents(const Mesh& mesh) {
  if (mesh.topology->cell_dimension() == 3) return check_volumes(mesh);
  if (mesh.topology->space_dimension() == 3) return check_areas<3>(mesh);
  check_areas<2>(mesh);
}

void check_hanging(const Mesh& mesh) {
  if (mesh.topology->cell_dimension() == 3) return check_boundary_faces(mesh);
  if (mesh.topology->space_dimension() == 3) return check_edges<3>(mesh);
  check_edges<2>(mesh);
}

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
