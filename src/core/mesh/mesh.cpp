#include "core/mesh/mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <tuple>

#include "core/error.h"
#include "core/search/box_tree.h"

namespace winslow {

namespace {

double cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

void check_finite(const Coordinates& coordinates) {
  for (Index i = 0; i < coordinates.size(); ++i) {
    if (!coordinates.xy(i).allFinite()) {
      throw MeshError(
          MeshEntity::node, i,
          "node " + std::to_string(i) + " has a coordinate that is not a finite number");
    }
  }
}

bool has_area(const Coordinates& coordinates, std::span<const Index> corners) {
  const std::size_t n = corners.size();
  double longest2 = 0;
  double largest2 = 0;
  for (std::size_t k = 0; k < n; ++k) {
    const Vec2 p = coordinates.xy(corners[k]);
    const Vec2 a = coordinates.xy(corners[(k + 1) % n]) - p;
    const Vec2 b = coordinates.xy(corners[(k + n - 1) % n]) - p;
    longest2 = std::max(longest2, a.squaredNorm());
    largest2 = std::max(largest2, std::abs(cross(a, b)));
  }
  // Round-off in the coordinates themselves leaves about this much of an exactly flat element.
  constexpr double flat = 1e-15;
  return largest2 > flat * longest2;
}

void check_areas(const Mesh& mesh) {
  for (Index e = 0; e < mesh.topology->element_count(); ++e) {
    if (!has_area(mesh.coordinates, mesh.topology->element(e))) {
      throw MeshError(
          MeshEntity::element, e,
          "element " + std::to_string(e) + " has no area (its corners lie on one line)");
    }
  }
}

void check_isolated(const Topology& topology) {
  if (topology.element_count() < 2) return;
  std::vector<unsigned char> joined(static_cast<std::size_t>(topology.element_count()), 0);
  for (const auto& edge : topology.edges()) {
    if (edge.elements[1] < 0) continue;
    for (const Index e : edge.elements) joined[static_cast<std::size_t>(e)] = 1;
  }
  const auto it = std::find(joined.begin(), joined.end(), 0);
  if (it == joined.end()) return;
  const auto e = static_cast<Index>(it - joined.begin());
  throw MeshError(MeshEntity::element, e,
                  "element " + std::to_string(e) + " shares no edge with any other (isolated)");
}

std::vector<Index> by_position(const Coordinates& coordinates, std::vector<Index> nodes) {
  std::sort(nodes.begin(), nodes.end(), [&](Index a, Index b) {
    const double* p = coordinates.point(a);
    const double* q = coordinates.point(b);
    return std::tie(p[0], p[1], a) < std::tie(q[0], q[1], b);
  });
  return nodes;
}

void check_duplicates(const Mesh& mesh) {
  std::vector<Index> used;
  for (Index i = 0; i < mesh.topology->node_count(); ++i) {
    if (mesh.topology->used(i)) used.push_back(i);
  }
  const auto sorted = by_position(mesh.coordinates, std::move(used));
  for (std::size_t k = 1; k < sorted.size(); ++k) {
    if (mesh.coordinates.xy(sorted[k - 1]) == mesh.coordinates.xy(sorted[k])) {
      throw MeshError(MeshEntity::node, sorted[k],
                      "node " + std::to_string(sorted[k]) + " lies exactly where node " +
                          std::to_string(sorted[k - 1]) + " does (duplicate node)");
    }
  }
}

/// The first of some nodes, by position, that lies inside an edge.
class HangingNodes {
 public:
  HangingNodes(const Coordinates& coordinates, std::vector<Index> candidates)
      : x_(coordinates), nodes_(by_position(coordinates, std::move(candidates))) {
    std::vector<Box<2>> places;
    places.reserve(nodes_.size());
    for (const Index node : nodes_) places.push_back({x_.xy(node), x_.xy(node)});
    tree_ = BoxTree<2>(places);
  }

  std::optional<Index> first_inside(const std::array<Index, 2>& edge) const {
    const Vec2 a = x_.xy(edge[0]);
    const Vec2 d = x_.xy(edge[1]) - a;
    const double length2 = d.squaredNorm();
    const auto inside = [&](Index node) {
      if (node == edge[0] || node == edge[1]) return false;
      const Vec2 p = x_.xy(node) - a;
      const double along = p.dot(d) / length2;
      return along > near && along < 1 - near && std::abs(cross(p, d)) < near * length2;
    };
    Box<2> box{a, a};
    box.add(a + d);
    const Vec2 slack = Vec2::Constant(near * std::sqrt(length2));
    auto first = static_cast<Index>(nodes_.size());
    tree_.overlapping({box.min - slack, box.max + slack}, [&](Index k) {
      if (k < first && inside(nodes_[static_cast<std::size_t>(k)])) first = k;
    });
    if (first == static_cast<Index>(nodes_.size())) return std::nullopt;
    return nodes_[static_cast<std::size_t>(first)];
  }

 private:
  static constexpr double near = 1e-9;  // of the edge's length

  const Coordinates& x_;
  std::vector<Index> nodes_;
  BoxTree<2> tree_;  // of nodes_
};

void check_hanging(const Mesh& mesh) {
  const Topology& topology = *mesh.topology;
  std::vector<Index> nodes;
  for (const auto& loop : topology.boundary_loops()) {
    nodes.insert(nodes.end(), loop.begin(), loop.end());
  }
  const HangingNodes hanging(mesh.coordinates, std::move(nodes));
  for (const auto& edge : topology.edges()) {
    if (edge.elements[1] >= 0) continue;
    const auto node = hanging.first_inside(edge.nodes);
    if (!node) continue;
    throw MeshError(MeshEntity::node, *node,
                    "node " + std::to_string(*node) + " lies inside the edge between nodes " +
                        std::to_string(edge.nodes[0]) + " and " + std::to_string(edge.nodes[1]) +
                        " (hanging node)");
  }
}

void add_warnings(const Topology& topology, std::vector<std::string>& warnings) {
  Index unused = 0;
  for (Index i = 0; i < topology.node_count(); ++i) unused += topology.used(i) ? 0 : 1;
  if (unused > 0) {
    warnings.push_back(std::to_string(unused) + " nodes belong to no element; they are kept");
  }
  if (topology.unmarked_boundary_edges() > 0) {
    warnings.push_back(std::to_string(topology.unmarked_boundary_edges()) +
                       " boundary edges belong to no marker; their nodes stay where they are");
  }
  if (topology.reversed_elements() > 0) {
    warnings.push_back(std::to_string(topology.reversed_elements()) +
                       " clockwise elements were turned counter-clockwise");
  }
}

}  // namespace

Mesh make_mesh(const MeshData& data, std::vector<std::string>* warnings) {
  check_finite(data.coordinates);
  Mesh mesh{Topology::build(data), data.coordinates};
  check_isolated(*mesh.topology);
  check_duplicates(mesh);
  check_areas(mesh);
  check_hanging(mesh);
  if (warnings) add_warnings(*mesh.topology, *warnings);
  return mesh;
}

Bounds bounds(const Coordinates& coordinates, std::span<const Index> nodes) {
  if (nodes.empty()) throw UsageError("bounds of no nodes");
  Bounds box{coordinates.xy(nodes.front()), coordinates.xy(nodes.front())};
  for (const Index node : nodes) {
    box.min = box.min.cwiseMin(coordinates.xy(node));
    box.max = box.max.cwiseMax(coordinates.xy(node));
  }
  return box;
}

Bounds bounds(const Mesh& mesh) {
  std::vector<Index> used;
  for (Index i = 0; i < mesh.topology->node_count(); ++i) {
    if (mesh.topology->used(i)) used.push_back(i);
  }
  return bounds(mesh.coordinates, used);
}

}  // namespace winslow
