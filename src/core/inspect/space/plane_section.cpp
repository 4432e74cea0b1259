#include "core/inspect/space/plane_section.h"

#include <Eigen/Geometry>
#include <utility>

#include "core/error.h"
#include "core/parallel/parallel_for.h"

namespace winslow {

Plane::Plane(const Vec3& point, const Vec3& normal) : point_(point), normal_(normal) {
  // Divided by the largest component first, since squares may overflow.
  const double largest = normal.cwiseAbs().maxCoeff();
  if (!point.allFinite() || !normal.allFinite() || largest == 0)
    throw UsageError("a plane needs a point and a normal of finite numbers, the normal not 0 0 0");
  normal_ = (normal / largest).normalized();
}

std::array<Vec3, 2> directions_in(const Vec3& unit_normal) {
  Index smallest = 0;
  unit_normal.cwiseAbs().minCoeff(&smallest);
  const Vec3 first = unit_normal.cross(Vec3::Unit(smallest)).normalized();
  return {first, unit_normal.cross(first)};
}

namespace {

constexpr Index block_size = 32;
constexpr double nearness = 1e-10;      // of a node to a plane, over the mesh's extent
constexpr double node_nearness = 1e-3;  // over the node's shortest edge

}  // namespace

SectionIndex::SectionIndex(const Mesh& mesh) {
  const Topology& topology = *mesh.topology;
  require_kind(topology, MeshKind::volume, "cuts by a plane");
  order_ = std::make_shared<const CurveOrder>(SpacePoints(mesh.coordinates), topology.node_count(),
                                              space_bounds(mesh), topology.elements());
  measure(mesh);
}

SectionIndex::SectionIndex(const Mesh& mesh, const SectionIndex& before) : order_(before.order_) {
  if (order_->corners.values.size() != mesh.topology->elements().values.size() ||
      order_->nodes.size() != at(mesh.coordinates.size()))
    throw UsageError("cuts by a plane: the index is of another mesh");
  measure(mesh);
}

void SectionIndex::measure(const Mesh& mesh) {
  const SpacePoints x(mesh.coordinates);
  places_.resize(order_->nodes.size());
  parallel_for(0, static_cast<Index>(places_.size()), [&](Index begin, Index end) {
    for (Index i = begin; i < end; ++i) places_[at(i)] = x[order_->nodes[at(i)]];
  });
  const Index count = order_->corners.rows();
  boxes_.resize(at((count + block_size - 1) / block_size));
  parallel_for(
      0, static_cast<Index>(boxes_.size()),
      [&](Index begin, Index end) {
        for (Index b = begin; b < end; ++b) {
          const Index last = std::min(count, (b + 1) * block_size);
          const auto first_value = at(order_->corners.offsets[at(b * block_size)]);
          const auto values =
              std::span(order_->corners.values)
                  .subspan(first_value, at(order_->corners.offsets[at(last)]) - first_value);
          boxes_[at(b)] = Box<3>::empty();
          for (const Index node : values) boxes_[at(b)].add(places_[at(node)]);
        }
      },
      256);
  extent_ = Box<3>::empty();
  for (const Box<3>& box : boxes_) extent_.add(box);
}

std::vector<Index> SectionIndex::near(const Plane& plane) const {
  std::vector<Index> near;
  const Vec3 across = plane.normal().cwiseAbs();
  const Index count = order_->corners.rows();
  const double size = extent_.size().norm();
  for (std::size_t b = 0; b < boxes_.size(); ++b) {
    // The shortest edge of a node in the block is no longer than the diagonal of the box.
    const double slack = node_nearness * boxes_[b].size().norm() + 2 * nearness * size;
    const double reach = 0.5 * across.dot(boxes_[b].size()) + slack;
    // The comparison is false for NaN, so that blocks with NaN are included.
    if (std::abs(plane.distance(boxes_[b].centre())) > reach) continue;
    const Index begin = static_cast<Index>(b) * block_size;
    for (Index e = begin; e < std::min(count, begin + block_size); ++e) near.push_back(e);
  }
  return near;
}

namespace {

/// Nodes and elements of a mesh in its own order, or in the order of an index, by their numbers in
/// that order.
class OrderedMesh {
 public:
  OrderedMesh(const Mesh& mesh, const SectionIndex* index)
      : mesh_(mesh),
        x_(mesh.coordinates),
        index_(index),
        rows_(index ? index->order().corners : mesh.topology->elements()) {}

  std::span<const Index> corners(Index e) const { return rows_[e]; }
  Vec3 point(Index node) const { return index_ ? index_->places()[at(node)] : x_[node]; }
  /// The number of an element in the mesh.
  Index element(Index e) const { return index_ ? index_->order().elements[at(e)] : e; }
  /// The number of a node in the mesh.
  Index node(Index i) const { return index_ ? index_->order().nodes[at(i)] : i; }
  const ElementShape& shape(Index e) const { return mesh_.topology->shape(element(e)); }
  ElementType type(Index e) const { return mesh_.topology->element_type(element(e)); }

 private:
  const Mesh& mesh_;
  SpacePoints x_;
  const SectionIndex* index_;
  const CompressedRows& rows_;
};

/// Signed distances of the nodes of a mesh from a plane, 0 for those that count as on it.
class PlaneDistance {
 public:
  PlaneDistance(const Mesh& mesh, const Plane& plane, const Box<3>& extent)
      : topology_(*mesh.topology), x_(mesh.coordinates), plane_(plane) {
    const double size = extent.size().norm();
    least_ = nearness * size;
    most_ = node_nearness * size;
  }

  double of(Index node) const {
    const double distance = plane_.distance(x_[node]);
    return std::abs(distance) <= least_ || (is_near(node) && is_in_near_face(node)) ? 0 : distance;
  }

 private:
  /// Whether a node is nearer than the share of its shortest edge.
  bool is_near(Index node) const {
    const Vec3 p = x_[node];
    const double away = std::abs(plane_.distance(p));
    if (away <= least_) return true;
    return away <= most_ && std::ranges::all_of(topology_.neighbours(node), [&](Index other) {
             return away <= node_nearness * (x_[other] - p).norm();
           });
  }
  /// Whether it is in a face of which all nodes are near. Where the plane passes near a single
  /// node, the section has the intersections with its edges.
  bool is_in_near_face(Index node) const {
    return std::ranges::any_of(topology_.star(node), [&](Index e) {
      const auto corners = topology_.element(e);
      return std::ranges::any_of(topology_.shape(e).faces, [&](const Face& local) {
        const Face face = by_nodes(local, corners);
        return std::ranges::find(face, node) != face.end() &&
               std::ranges::all_of(face, [&](Index other) { return is_near(other); });
      });
    });
  }

  const Topology& topology_;
  SpacePoints x_;
  const Plane& plane_;
  double least_, most_;  // most_: no node farther away is near
};

/// Distances of all nodes of a mesh.
std::vector<double> distances(const Mesh& mesh, const Plane& plane) {
  require_kind(*mesh.topology, MeshKind::volume, "cuts by a plane");
  const PlaneDistance distance(mesh, plane, space_bounds(mesh));
  std::vector<double> d(at(mesh.coordinates.size()));
  parallel_for(0, mesh.coordinates.size(), [&](Index begin, Index end) {
    for (Index i = begin; i < end; ++i) d[at(i)] = distance.of(i);
  });
  return d;
}

/// The side of a plane on which each node lies, its distance, and its list of section points (see
/// EdgePoints).
class NodeSides {
 public:
  /// front_on_plane: nodes on the plane count as in front of it.
  NodeSides(Index nodes, bool front_on_plane)
      : front_on_plane_(front_on_plane),
        sides_(at(nodes), unknown),
        nodes_(std::make_unique_for_overwrite<Node[]>(at(nodes))) {}

  bool known(Index node) const { return sides_[at(node)] != unknown; }
  void put(Index node, double distance) {
    const bool in_front = front_on_plane_ ? distance >= 0 : distance > 0;
    sides_[at(node)] = in_front ? front : behind;
    nodes_[at(node)] = {distance, -1};
  }
  bool in_front(Index node) const { return sides_[at(node)] == front; }
  double distance(Index node) const { return nodes_[at(node)].distance; }
  /// The first section point in the list of the node; -1: the list is empty.
  Index& first_point(Index node) { return nodes_[at(node)].first_point; }
  /// Whether there are nodes on both sides.
  bool divides(std::span<const Index> nodes) const {
    unsigned met = 0;
    for (const Index node : nodes) met |= sides_[at(node)];
    return met == (front | behind);
  }

 private:
  static constexpr unsigned char unknown = 0, behind = 1, front = 2;
  struct Node {
    double distance;
    Index first_point;
  };

  bool front_on_plane_;
  std::vector<unsigned char> sides_;  // small, to stay in the cache
  // Not initialised: memory for nodes that are not known is never touched.
  std::unique_ptr<Node[]> nodes_;
};

/// Finds the point of a section on an edge, which a section needs about four times for each point.
/// Each node has a list of the points on its edges to the other side of the plane; these lists are
/// short, and lists of neighbours are near in memory.
class EdgePoints {
 public:
  struct Found {
    Index point;
    bool fresh;
  };
  void reserve(std::size_t points) { entries_.reserve(points); }
  /// first: NodeSides::first_point() of one end.
  Found find_or_add(Index& first, Index other_end) {
    for (Index k = first; k >= 0; k = entries_[at(k)].next)
      if (entries_[at(k)].other_end == other_end) return {k, false};
    const auto point = static_cast<Index>(entries_.size());
    entries_.push_back({other_end, first});
    first = point;
    return {point, true};
  }

 private:
  struct Entry {
    Index other_end, next;
  };
  std::vector<Entry> entries_;  // by point
};

/// The edges of a tetrahedron that a plane cuts, in the order around the section.
struct TetrahedronCut {
  std::array<std::array<std::uint8_t, 2>, 4> edges{};  ///< from behind to the front
  std::size_t count = 0;
};

/// front: bit k is set if corner k lies in front. The rule is that of other elements, see
/// Cutter::cut_face().
TetrahedronCut cut_of_tetrahedron(unsigned front) {
  const auto in_front = [&](Index k) { return (front >> static_cast<unsigned>(k) & 1U) != 0; };
  std::vector<std::array<Index, 2>> crossings;
  std::array<std::size_t, 4> next{};
  const auto find = [&](Index behind, Index before) {
    const std::array<Index, 2> edge{behind, before};
    const std::size_t k = index_of(crossings, edge);
    if (k == crossings.size()) crossings.push_back(edge);
    return k;
  };
  for (const Face& face : shape_of(ElementType::tetrahedron).faces) {
    std::optional<std::size_t> enters, leaves;
    for (std::size_t k = 0; k < face.size(); ++k) {
      const Index a = face[k], b = face[(k + 1) % face.size()];
      if (in_front(a) == in_front(b)) continue;
      if (in_front(b))
        enters = find(a, b);
      else
        leaves = find(b, a);
    }
    if (leaves) next[*leaves] = *enters;
  }
  TetrahedronCut cut;
  for (std::size_t k = 0; cut.count < crossings.size(); k = next[k], ++cut.count)
    cut.edges[cut.count] = {static_cast<std::uint8_t>(crossings[k][0]),
                            static_cast<std::uint8_t>(crossings[k][1])};
  return cut;
}

const std::array<TetrahedronCut, 16>& tetrahedron_cuts() {
  static const std::array<TetrahedronCut, 16> all = [] {
    std::array<TetrahedronCut, 16> cuts;
    for (unsigned front = 0; front < cuts.size(); ++front) cuts[front] = cut_of_tetrahedron(front);
    return cuts;
  }();
  return all;
}

/// Cuts elements and collects the section.
class Cutter {
 public:
  Cutter(const OrderedMesh& mesh, const Plane& plane, NodeSides& sides)
      : mesh_(mesh), plane_(plane), sides_(sides) {}

  /// met: elements that the plane divides.
  PlaneSection cut(std::span<const Index> met) {
    // A plane tiling of n triangles has about n / 2 corners.
    point_of_.reserve(met.size() * 2 / 3);
    section_.points.reserve(met.size() * 2 / 3);
    section_.elements.reserve(met.size());
    section_.polygons.values.reserve(4 * met.size());
    for (const Index e : met) {
      const auto corners = mesh_.corners(e);
      if (mesh_.type(e) == ElementType::tetrahedron)
        cut_tetrahedron(e, corners);
      else
        cut_element(e, corners);
    }
    return std::move(section_);
  }

 private:
  void cut_tetrahedron(Index e, std::span<const Index> corners) {
    unsigned front = 0;
    for (std::size_t k = 0; k < 4; ++k)
      if (in_front(corners[k])) front |= 1U << k;
    const TetrahedronCut& cut = tetrahedron_cuts()[front];
    std::array<Index, 4> points{};
    for (std::size_t k = 0; k < cut.count; ++k)
      points[k] = point_at(corners[cut.edges[k][0]], corners[cut.edges[k][1]]);
    auto& polygons = section_.polygons;
    const std::size_t begin = polygons.values.size();
    for (std::size_t k = 0; k < cut.count; ++k) put_point(begin, points[k]);
    end_polygon(e, begin);
  }

  /// An edge of an element that crosses the plane.
  struct Crossing {
    Index behind, front;  // nodes
    std::size_t next;     // crossing that follows around the section
    bool done;
  };

  bool in_front(Index node) const { return sides_.in_front(node); }

  std::size_t find_crossing(Index behind, Index front) {
    std::size_t k = 0;
    while (k < crossings_.size() &&
           (crossings_[k].behind != behind || crossings_[k].front != front))
      ++k;
    if (k == crossings_.size()) crossings_.push_back({behind, front, 0, false});
    return k;
  }

  void cut_element(Index e, std::span<const Index> corners) {
    crossings_.clear();
    for (const Face& face : mesh_.shape(e).faces) cut_face(by_nodes(face, corners));
    for (std::size_t k = 0; k < crossings_.size(); ++k)
      if (!crossings_[k].done) add_polygon(e, k);
  }

  /// Adds the sides of the section in a face. Each side leads from a crossing at which the outline
  /// of the face (counter-clockwise from outside) leaves the front to one at which it enters the
  /// front: then the section is on its left seen from the front.
  void cut_face(const Face& face) {
    std::vector<std::size_t>& at_crossing = at_crossing_;
    std::vector<unsigned char>& enters = enters_;
    at_crossing.clear();
    enters.clear();
    for (std::size_t k = 0; k < face.size(); ++k) {
      const Index a = face[k], b = face[(k + 1) % face.size()];
      if (in_front(a) == in_front(b)) continue;
      enters.push_back(in_front(b) ? 1 : 0);
      at_crossing.push_back(in_front(b) ? find_crossing(a, b) : find_crossing(b, a));
    }
    const std::size_t n = enters.size();
    const bool around_behind = face.size() > 4 || (n == 4 && front_joined(face));
    for (std::size_t k = 0; k < n; ++k) {
      if (enters[k] != 0) continue;
      const std::size_t to = around_behind || n == 2 ? (k + 1) % n : (k + n - 1) % n;
      crossings_[at_crossing[k]].next = at_crossing[to];
    }
  }

  /// For a quadrilateral with two opposite corners in front: whether the saddle point of the
  /// bilinear distance also lies in front. Compares products of two numbers, so that both elements
  /// of the face get the same result.
  bool front_joined(const Face& face) const {
    const std::size_t first = in_front(face[0]) ? 0 : 1;
    const auto d = [&](std::size_t k) { return sides_.distance(face[(first + k) % 4]); };
    return d(0) * d(2) > d(1) * d(3);
  }

  Index point_at(Index behind_node, Index front_node) {
    // A node on the plane is one point for all of its edges.
    const double front = sides_.distance(front_node), behind = sides_.distance(behind_node);
    const Index a = front == 0 ? front_node : behind_node;
    const Index b = behind == 0 ? behind_node : front_node;
    const auto [point, fresh] = point_of_.find_or_add(sides_.first_point(a), b);
    if (fresh) {
      const Vec3 p = mesh_.point(a), q = mesh_.point(b);
      section_.points.emplace_back(a == b ? Vec3(p - plane_.distance(p) * plane_.normal())
                                          : Vec3(p + (q - p) * (behind / (behind - front))));
    }
    return point;
  }

  void add_polygon(Index e, std::size_t first) {
    auto& polygons = section_.polygons;
    const std::size_t begin = polygons.values.size();
    std::size_t k = first;
    do {
      crossings_[k].done = true;
      put_point(begin, point_at(crossings_[k].behind, crossings_[k].front));
      k = crossings_[k].next;
    } while (k != first);
    end_polygon(e, begin);
  }

  /// Adds a corner of a polygon unless it repeats the last one. begin: index of the first corner.
  void put_point(std::size_t begin, Index point) {
    auto& values = section_.polygons.values;
    if (values.size() == begin || values.back() != point) values.push_back(point);
  }

  /// Ends a polygon: a last corner equal to the first is removed, and so is a polygon with fewer
  /// than three corners.
  void end_polygon(Index e, std::size_t begin) {
    auto& polygons = section_.polygons;
    while (polygons.values.size() > begin + 1 && polygons.values.back() == polygons.values[begin])
      polygons.values.pop_back();
    if (polygons.values.size() < begin + 3) return polygons.values.resize(begin);
    polygons.end_row();
    section_.elements.push_back(mesh_.element(e));
  }

  const OrderedMesh& mesh_;
  const Plane& plane_;
  NodeSides& sides_;
  std::vector<Crossing> crossings_;       // of an element
  std::vector<std::size_t> at_crossing_;  // of a face
  std::vector<unsigned char> enters_;     // of a face
  EdgePoints point_of_;
  PlaneSection section_;
};

PlaneSection whole_section(const Mesh& mesh, const Plane& plane,
                           const std::vector<double>& distances, bool front_on_plane) {
  NodeSides sides(mesh.coordinates.size(), front_on_plane);
  for (std::size_t i = 0; i < distances.size(); ++i) sides.put(static_cast<Index>(i), distances[i]);
  // The plane divides few elements; all threads find them first.
  const Topology& topology = *mesh.topology;
  std::vector<unsigned char> flags(at(topology.element_count()));
  parallel_for(0, topology.element_count(), [&](Index begin, Index end) {
    for (Index e = begin; e < end; ++e) flags[at(e)] = sides.divides(topology.element(e)) ? 1 : 0;
  });
  std::vector<Index> met;
  for (Index e = 0; e < topology.element_count(); ++e)
    if (flags[at(e)] != 0) met.push_back(e);
  return Cutter(OrderedMesh(mesh, nullptr), plane, sides).cut(met);
}

PlaneSection indexed_section(const Mesh& mesh, const Plane& plane, const SectionIndex& index,
                             bool front_on_plane) {
  const PlaneDistance distance(mesh, plane, index.extent());
  const OrderedMesh ordered(mesh, &index);
  NodeSides sides(mesh.coordinates.size(), front_on_plane);
  std::vector<Index> met = index.near(plane);
  std::erase_if(met, [&](Index e) {
    const auto corners = ordered.corners(e);
    for (const Index node : corners)
      if (!sides.known(node)) sides.put(node, distance.of(ordered.node(node)));
    return !sides.divides(corners);
  });
  return Cutter(ordered, plane, sides).cut(met);
}

}  // namespace

PlaneSection plane_section(const Mesh& mesh, const Plane& plane, const SectionIndex* index) {
  if (index) {
    PlaneSection section = indexed_section(mesh, plane, *index, true);
    return section.elements.empty() ? indexed_section(mesh, plane, *index, false) : section;
  }
  const std::vector<double> d = distances(mesh, plane);
  PlaneSection section = whole_section(mesh, plane, d, true);
  return section.elements.empty() ? whole_section(mesh, plane, d, false) : section;
}

std::vector<unsigned char> elements_behind(const Mesh& mesh, std::span<const Plane> planes) {
  std::vector<unsigned char> left(at(mesh.topology->element_count()), 1);
  for (const Plane& plane : planes) {
    const std::vector<double> d = distances(mesh, plane);
    parallel_for(0, mesh.topology->element_count(), [&](Index begin, Index end) {
      for (Index e = begin; e < end; ++e) {
        const auto corners = mesh.topology->element(e);
        if (std::ranges::none_of(corners, [&](Index node) { return d[at(node)] < 0; }))
          left[at(e)] = 0;
      }
    });
  }
  return left;
}

namespace {

/// Twice the area of a triangle, positive if it is counter-clockwise.
double doubled_area(const Vec2& a, const Vec2& b, const Vec2& c) { return cross(b - a, c - a); }

/// Whether a corner can be cut off: its triangle is positive and holds no other corner.
bool is_ear(const std::vector<Vec2>& p, const std::vector<Index>& left, std::size_t k) {
  const std::size_t n = left.size();
  const Index a = left[(k + n - 1) % n], b = left[k], c = left[(k + 1) % n];
  if (doubled_area(p[at(a)], p[at(b)], p[at(c)]) <= 0) return false;
  return std::ranges::none_of(left, [&](Index other) {
    if (other == a || other == b || other == c) return false;
    const Vec2& q = p[at(other)];
    return doubled_area(p[at(a)], p[at(b)], q) >= 0 && doubled_area(p[at(b)], p[at(c)], q) >= 0 &&
           doubled_area(p[at(c)], p[at(a)], q) >= 0;
  });
}

}  // namespace

std::vector<Index> cut_polygon(std::span<const Vec3> corners, const Vec3& normal) {
  if (corners.size() == 3) return {0, 1, 2};
  const auto [u, v] = directions_in(normal);
  std::vector<Vec2> p;
  std::vector<Index> left;
  for (const Vec3& corner : corners) {
    const Vec3 r = corner - corners[0];
    left.push_back(static_cast<Index>(p.size()));
    p.emplace_back(u.dot(r), v.dot(r));
  }
  std::vector<Index> triangles;
  while (left.size() > 2) {
    const std::size_t n = left.size();
    std::size_t ear = 1;
    for (std::size_t k = 0; k < n; ++k) {
      const std::size_t candidate = (k + 1) % n;
      if (!is_ear(p, left, candidate)) continue;
      ear = candidate;
      break;
    }
    for (const std::size_t k : {ear + n - 1, ear, ear + 1}) triangles.push_back(left[k % n]);
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(ear));
  }
  return triangles;
}

}  // namespace winslow
