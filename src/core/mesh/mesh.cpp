#include "core/mesh/mesh.h"

#include <Eigen/Geometry>
#include <utility>

#include "core/error.h"
#include "core/parallel/parallel_for.h"

namespace winslow {

namespace {

std::string turned_text(const Topology& topology) {
  constexpr std::array<const char*, 3> texts{
      " clockwise elements were turned counter-clockwise",
      " elements were turned to face as their neighbours do",
      " elements with mirrored corners were turned inside out",
  };
  return std::to_string(topology.reversed_elements()) +
         texts[static_cast<std::size_t>(topology.kind())];
}

void add_warnings(const Topology& topology, std::vector<std::string>& warnings) {
  Index unused = 0;
  for (Index i = 0; i < topology.node_count(); ++i) unused += topology.used(i) ? 0 : 1;
  if (unused > 0) {
    warnings.push_back(std::to_string(unused) + " nodes belong to no element; they are kept");
  }
  if (topology.markers().unmarked_faces() > 0) {
    warnings.push_back(std::to_string(topology.markers().unmarked_faces()) + " boundary " +
                       std::string(words_of(topology.kind()).face) +
                       "s belong to no marker; their nodes stay where they are");
  }
  if (topology.reversed_elements() > 0) warnings.push_back(turned_text(topology));
}

/// Area of the parallelogram between two vectors.
double area(const Vec2& a, const Vec2& b) { return std::abs(cross(a, b)); }
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

/// Ascending by their coordinates, x first, then by number.
template <int D>
std::vector<Index> by_position(const Points<D>& x, std::vector<Index> nodes) {
  std::ranges::sort(nodes, [&](Index a, Index b) {
    const Vec<D> p = x[a], q = x[b];
    for (int k = 0; k < D; ++k) {
      if (p[k] != q[k]) return p[k] < q[k];
    }
    return a < b;
  });
  return nodes;
}

std::vector<Index> used_nodes(const Topology& topology) {
  std::vector<Index> nodes;
  for (Index i = 0; i < topology.node_count(); ++i)
    if (topology.used(i)) nodes.push_back(i);
  return nodes;
}

/// The nodes of boundary faces, ascending. Topology::on_boundary() is true for nodes of markers
/// inside the mesh, too.
std::vector<Index> boundary_nodes(const Topology& topology) {
  std::vector<Index> nodes;
  for_boundary_faces(topology, [&](Index, const auto& face) {
    nodes.insert(nodes.end(), face.nodes.begin(), face.nodes.end());
  });
  sort_unique(nodes);
  return nodes;
}

[[noreturn]] void refuse_duplicate(Index first, Index second) {
  throw MeshError(MeshEntity::node, second,
                  "node " + std::to_string(second) + " lies exactly where node " +
                      std::to_string(first) + " does (duplicate node)");
}

/// Refuses elements with two corners at one place: these cannot be the two sides of a crack.
template <int D>
void check_corners_apart(const Mesh& mesh, const Points<D>& x,
                         const std::vector<bool>& shared_place) {
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

/// Refuses two used nodes at one place, unless both are on the boundary and of different elements:
/// the two sides of a crack or of a baffle without thickness. Returns the number of nodes at the
/// place of another node.
Index check_duplicates(const Mesh& mesh) {
  std::vector<bool> on_boundary(at(mesh.topology->node_count()), false);
  for (const Index node : boundary_nodes(*mesh.topology)) on_boundary[at(node)] = true;
  return in_dimension(mesh.coordinates, [&](const auto& x) {
    std::vector<bool> shared_place(on_boundary.size(), false);
    Index count = 0;
    Index first = -1;  // of the nodes at one place
    for (const Index node : by_position(x, used_nodes(*mesh.topology))) {
      if (first < 0 || x[first] != x[node]) {
        first = node;
        continue;
      }
      if (!on_boundary[at(first)] || !on_boundary[at(node)]) refuse_duplicate(first, node);
      shared_place[at(first)] = shared_place[at(node)] = true;
      ++count;
    }
    if (count > 0) check_corners_apart(mesh, x, shared_place);
    return count;
  });
}

/// The first of some nodes, in the order of their positions, that lies inside an edge or a face.
template <int D>
class HangingNodes {
 public:
  static constexpr double near = 1e-9;  // of the size of an edge or a face

  HangingNodes(const Points<D>& x, std::vector<Index> candidates)
      : nodes_(by_position(x, std::move(candidates))) {
    std::vector<Vec<D>> places;
    places.reserve(nodes_.size());
    for (const Index node : nodes_) places.push_back(x[node]);
    tree_ = BoxTree<D>(places);
  }

  /// Calls inside(node) for nodes in the box, which grows by `near` of the size on every side.
  template <class Inside>
  std::optional<Index> first(const Box<D>& box, double size, const Inside& inside) const {
    const Vec<D> slack = Vec<D>::Constant(near * size);
    auto first = static_cast<Index>(nodes_.size());
    tree_.overlapping({box.min - slack, box.max + slack}, [&](Index k) {
      if (k < first && inside(nodes_[at(k)])) first = k;
    });
    if (first == static_cast<Index>(nodes_.size())) return std::nullopt;
    return nodes_[at(first)];
  }

 private:
  std::vector<Index> nodes_;
  BoxTree<D> tree_;  // of nodes_
};

[[noreturn]] void refuse_hanging(Index node, const std::string& where) {
  throw MeshError(MeshEntity::node, node,
                  "node " + std::to_string(node) + " lies inside the " + where + " (hanging node)");
}

/// For a plane or surface mesh: refuses boundary nodes inside a boundary edge.
template <int D>
void check_hanging(const Topology& topology, const Points<D>& x) {
  const HangingNodes<D> hanging(x, boundary_nodes(topology));
  for_boundary_faces(topology, [&](Index, const Topology::SharedFace& face) {
    const auto [start, end] = face.nodes.edge();
    const Vec<D> a = x[start], d = x[end] - a;
    const double length2 = d.squaredNorm();
    Box<D> box{a, a};
    box.add(a + d);
    const auto node = hanging.first(box, std::sqrt(length2), [&](Index i) {
      if (std::ranges::find(face.nodes, i) != face.nodes.end()) return false;
      const Vec<D> p = x[i] - a;
      const double along = p.dot(d) / length2;
      constexpr double near = HangingNodes<D>::near;
      return along > near && along < 1 - near && area(p, d) < near * length2;
    });
    if (node) refuse_hanging(*node, "edge between " + nodes_text(face.nodes));
  });
}

/// Whether the parallelepiped of some corner is larger than round-off.
bool has_volume(const SpacePoints& x, const ElementShape& shape, std::span<const Index> corners) {
  double longest2 = 0;
  double largest3 = 0;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Face& link = shape.links[k];
    const Vec3 p = x[corners[k]];
    const auto edge = [&](std::size_t i) { return Vec3(x[corners[at(link[i])]] - p); };
    for (std::size_t i = 0; i + 2 < link.size(); ++i) {
      const Vec3 a = edge(i), b = edge(i + 1), c = edge(i + 2);
      longest2 = std::max({longest2, a.squaredNorm(), b.squaredNorm(), c.squaredNorm()});
      largest3 = std::max(largest3, std::abs(a.dot(b.cross(c))));
      if (shape.type != ElementType::polyhedron) break;
    }
  }
  constexpr double flat = 1e-15;
  return largest3 > flat * longest2 * std::sqrt(longest2);
}

/// Whether p lies on the triangle or on one of its edges, but not at a corner.
bool on_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  constexpr double near = HangingNodes<3>::near;
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
  for (std::size_t k = 1; k + 1 < face.size(); ++k)
    if (on_triangle(p, x[face[0]], x[face[k]], x[face[k + 1]])) return true;
  return false;
}

/// Refuses elements for which has_extent(e) is false. fault: "area (...)".
template <class HasExtent>
void check_extents(const Topology& topology, const char* fault, const HasExtent& has_extent) {
  parallel_for(0, topology.element_count(), [&](Index begin, Index end) {
    for (Index e = begin; e < end; ++e)
      if (!has_extent(e))
        throw MeshError(MeshEntity::element, e,
                        "element " + std::to_string(e) + " has no " + fault);
  });
}

/// For a volume mesh: refuses boundary nodes inside a boundary face of which they are no corners.
/// Not beside polyhedra, of which hanging nodes are corners: there such nodes are on walls that
/// touch, which snappyHexMesh makes. Returns the number of faces with such a node.
Index check_hanging_on_faces(const Topology& topology, const SpacePoints& x) {
  Index count = 0;
  const HangingNodes<3> hanging(x, boundary_nodes(topology));
  for_boundary_faces(topology, [&](Index, const Topology::SharedFace& face) {
    Box<3> box = Box<3>::empty();
    for (const Index node : face.nodes) box.add(x[node]);
    const auto node = hanging.first(box, box.size().norm(), [&](Index i) {
      return std::ranges::find(face.nodes, i) == face.nodes.end() && on_face(x, face.nodes, x[i]);
    });
    if (node && !topology.has_polyhedra())
      refuse_hanging(*node, "face with " + nodes_text(face.nodes));
    count += node ? 1 : 0;
  });
  return count;
}

/// Refuses elements without extent and hanging nodes. Returns check_hanging_on_faces().
Index check_shapes(const Mesh& mesh) {
  const Topology& topology = *mesh.topology;
  if (topology.kind() == MeshKind::volume) {
    const SpacePoints x(mesh.coordinates);
    check_extents(topology, "volume (its corners lie in one plane)",
                  [&](Index e) { return has_volume(x, topology.shape(e), topology.element(e)); });
    return check_hanging_on_faces(topology, x);
  }
  in_dimension(mesh.coordinates, [&](const auto& x) {
    check_extents(topology, "area (its corners lie on one line)",
                  [&](Index e) { return has_area(x, topology.element(e)); });
    check_hanging(topology, x);
  });
  return 0;
}

void check_finite(const Coordinates& coordinates) {
  const auto values = coordinates.values();
  const auto it = std::ranges::find_if_not(values, [](double v) { return std::isfinite(v); });
  if (it == values.end()) return;
  const auto node = static_cast<Index>((it - values.begin()) / coordinates.dimension());
  throw MeshError(MeshEntity::node, node,
                  "node " + std::to_string(node) + " has a coordinate that is not a finite number");
}

/// Refuses an element that shares no face with another one, in a mesh of several elements.
void check_isolated(const Topology& topology) {
  if (topology.element_count() < 2) return;
  std::vector<bool> joined(at(topology.element_count()), false);
  for (Index f = 0; f < topology.face_count(); ++f) {
    const auto elements = topology.face(f).elements;
    if (elements[1] < 0) continue;
    for (const Index e : elements) joined[at(e)] = true;
  }
  const auto it = std::ranges::find(joined, false);
  if (it == joined.end()) return;
  const auto e = static_cast<Index>(it - joined.begin());
  throw MeshError(MeshEntity::element, e,
                  "element " + std::to_string(e) + " shares no " +
                      std::string(words_of(topology.kind()).face) + " with any other (isolated)");
}

}  // namespace

Mesh make_mesh(const MeshData& data, std::vector<std::string>* warnings) {
  check_finite(data.coordinates);
  Mesh mesh{Topology::build(data), data.coordinates};
  check_isolated(*mesh.topology);
  const Index doubled = check_duplicates(mesh);
  const Index touched = check_shapes(mesh);
  if (warnings) add_warnings(*mesh.topology, *warnings);
  if (warnings && doubled > 0) {
    warnings->push_back(std::to_string(doubled) +
                        " boundary nodes lie where others do: a crack or a baffle, or parts that "
                        "were not joined");
  }
  if (warnings && touched > 0) {
    warnings->push_back(
        std::to_string(touched) +
        (touched == 1 ? " boundary face has a node" : " boundary faces have nodes") +
        " of another one inside: walls that touch, or parts that were not joined");
  }
  return mesh;
}

namespace {

template <int D>
Box<D> box_around(const Coordinates& coordinates, std::span<const Index> nodes) {
  if (nodes.empty()) throw UsageError("bounds of no nodes");
  const Points<D> x(coordinates);
  Box<D> box = Box<D>::empty();
  for (const Index node : nodes) box.add(x[node]);
  return box;
}

}  // namespace

Bounds bounds(const Coordinates& coordinates, std::span<const Index> nodes) {
  return box_around<2>(coordinates, nodes);
}

Bounds bounds(const Mesh& mesh) {
  require_plane(*mesh.topology, "bounds");
  return bounds(mesh.coordinates, used_nodes(*mesh.topology));
}

Box<3> space_bounds(const Coordinates& coordinates, std::span<const Index> nodes) {
  return box_around<3>(coordinates, nodes);
}

Box<3> space_bounds(const Mesh& mesh) {
  return space_bounds(mesh.coordinates, used_nodes(*mesh.topology));
}

LocalFrame::LocalFrame(const Mesh& mesh) {
  if (mesh.topology->kind() == MeshKind::surface) require_plane(*mesh.topology, "bounds");
  in_dimension(mesh.coordinates, [&](const auto& x) {
    constexpr int dimension = std::remove_cvref_t<decltype(x)>::dimension;
    constexpr double far = 16;
    const auto box = box_around<dimension>(mesh.coordinates, used_nodes(*mesh.topology));
    const double extent = box.size().maxCoeff();
    const Vec<dimension> centre = box.centre();
    for (int axis = 0; axis < dimension; ++axis) {
      if (std::abs(centre[axis]) > far * extent) origin_[axis] = centre[axis];
    }
  });
}

Coordinates LocalFrame::to_local(Coordinates x) const {
  const auto values = x.values();
  const auto n = static_cast<std::size_t>(x.dimension());
  for (std::size_t k = 0; k < values.size(); ++k) values[k] -= origin_[static_cast<int>(k % n)];
  return x;
}

Coordinates LocalFrame::to_mesh(Coordinates x, const Coordinates& rest) const {
  const Coordinates before = to_local(rest);
  const auto values = x.values();
  const auto n = static_cast<std::size_t>(x.dimension());
  for (Index node = 0; node < x.size(); ++node) {
    if (node < rest.size() && x.same_place(node, before)) {
      x.copy_node(node, rest);
      continue;
    }
    for (std::size_t k = 0; k < n; ++k) values[at(node) * n + k] += origin_[static_cast<int>(k)];
  }
  return x;
}

}  // namespace winslow
