#include "core/mesh/topology_builder.h"

#include <algorithm>
#include <numeric>
#include <tuple>

#include "core/error.h"
#include "core/mesh/half_edge.h"

namespace winslow {

namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

std::string edge_text(Index a, Index b) {
  return "the edge between nodes " + std::to_string(a) + " and " + std::to_string(b);
}

/// Twice the signed area of a polygon (shoelace formula), relative to its first corner.
double signed_area2(const Coordinates& coordinates, std::span<const Index> corners) {
  const Vec2 o = coordinates.xy(corners[0]);
  double sum = 0;
  for (std::size_t k = 1; k + 1 < corners.size(); ++k) {
    const Vec2 a = coordinates.xy(corners[k]) - o;
    const Vec2 b = coordinates.xy(corners[k + 1]) - o;
    sum += a.x() * b.y() - a.y() * b.x();
  }
  return sum;
}

void sort_unique(std::vector<Index>& v) {
  std::sort(v.begin(), v.end());
  v.erase(std::unique(v.begin(), v.end()), v.end());
}

}  // namespace

TopologyBuilder::TopologyBuilder(const MeshData& data)
    : data_(data), topology_(std::shared_ptr<Topology>(new Topology)) {}

std::shared_ptr<const Topology> TopologyBuilder::build() {
  check_elements();
  topology_->types_ = data_.types;
  topology_->elements_.offsets = data_.element_offsets;
  topology_->elements_.values = data_.element_nodes;
  topology_->regions_ = data_.regions;
  topology_->element_region_ = data_.element_region;
  pair_edges();
  orient_elements();
  check_manifold_nodes();
  build_half_edges();
  build_stars();
  build_loops();
  build_markers();
  constrain_nodes();
  return topology_;
}

void TopologyBuilder::check_elements() const {
  const Index nodes = data_.node_count();
  if (data_.element_count() == 0) throw MeshError(MeshEntity::mesh, 0, "the mesh has no elements");
  for (Index e = 0; e < data_.element_count(); ++e) {
    const auto corners = data_.element(e);
    for (std::size_t k = 0; k < corners.size(); ++k) {
      if (corners[k] < 0 || corners[k] >= nodes) {
        throw MeshError(MeshEntity::element, e,
                        "element " + std::to_string(e) + " uses node " +
                            std::to_string(corners[k]) + ", expected 0 to " +
                            std::to_string(nodes - 1));
      }
      for (std::size_t m = 0; m < k; ++m) {
        if (corners[m] == corners[k]) {
          throw MeshError(MeshEntity::element, e,
                          "element " + std::to_string(e) + " uses node " +
                              std::to_string(corners[k]) + " twice, expected distinct corners");
        }
      }
    }
  }
}

void TopologyBuilder::pair_edges() {
  struct Side {
    Index low, high, corner, element;
  };
  std::vector<Side> sides;
  sides.reserve(data_.element_nodes.size());
  for (Index e = 0; e < data_.element_count(); ++e) {
    const auto c = data_.element(e);
    for (std::size_t k = 0; k < c.size(); ++k) {
      const auto [low, high] = std::minmax(c[k], c[(k + 1) % c.size()]);
      sides.push_back({low, high, data_.element_offsets[at(e)] + static_cast<Index>(k), e});
    }
  }
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
    return std::tie(a.low, a.high, a.corner) < std::tie(b.low, b.high, b.corner);
  });
  corner_edge_.assign(data_.element_nodes.size(), -1);
  for (std::size_t i = 0; i < sides.size();) {
    std::size_t j = i + 1;
    while (j < sides.size() && sides[j].low == sides[i].low && sides[j].high == sides[i].high) ++j;
    if (j - i > 2) {
      throw MeshError(MeshEntity::element, sides[i + 2].element,
                      edge_text(sides[i].low, sides[i].high) + " is shared by " +
                          std::to_string(j - i) + " elements, expected at most 2 (non-manifold)");
    }
    const auto edge = static_cast<Index>(topology_->edges_.size());
    topology_->edges_.push_back({{sides[i].low, sides[i].high},
                                 {sides[i].element, j - i == 2 ? sides[i + 1].element : -1}});
    for (; i < j; ++i) corner_edge_[at(sides[i].corner)] = edge;
  }
}

void TopologyBuilder::walk_part(Index seed, std::vector<signed char>& flip,
                                std::vector<unsigned char>& seen, std::vector<Index>& part) const {
  // Does the element's own order run from low to high along the edge behind this corner?
  const auto ascends = [&](Index e, std::size_t k) {
    const auto c = data_.element(e);
    return c[k] < c[(k + 1) % c.size()];
  };
  const auto corner_of_edge = [&](Index e, Index edge) {
    const auto begin = corner_edge_.begin() + data_.element_offsets[at(e)];
    const auto end = corner_edge_.begin() + data_.element_offsets[at(e) + 1];
    return static_cast<std::size_t>(std::find(begin, end, edge) - begin);
  };
  part.assign(1, seed);
  seen[at(seed)] = 1;
  for (std::size_t head = 0; head < part.size(); ++head) {
    const Index e = part[head];
    const auto corners = data_.element(e).size();
    for (std::size_t k = 0; k < corners; ++k) {
      const Index edge = corner_edge_[at(data_.element_offsets[at(e)]) + k];
      const auto& pair = topology_->edges_[at(edge)];
      const Index other = pair.elements[0] == e ? pair.elements[1] : pair.elements[0];
      if (other < 0 || other == e) continue;
      const bool same = ascends(e, k) == ascends(other, corner_of_edge(other, edge));
      const auto wanted = static_cast<signed char>(same ? !flip[at(e)] : flip[at(e)]);
      if (!seen[at(other)]) {
        seen[at(other)] = 1;
        flip[at(other)] = wanted;
        part.push_back(other);
      } else if (flip[at(other)] != wanted) {
        throw MeshError(MeshEntity::element, other,
                        "element " + std::to_string(other) +
                            " cannot be oriented like its neighbours (the surface is one-sided)");
      }
    }
  }
}

void TopologyBuilder::check_open(const std::vector<Index>& part) const {
  for (const Index e : part) {
    for (Index c = data_.element_offsets[at(e)]; c < data_.element_offsets[at(e) + 1]; ++c) {
      if (topology_->edges_[at(corner_edge_[at(c)])].elements[1] < 0) return;
    }
  }
  throw MeshError(
      MeshEntity::element, part.front(),
      "element " + std::to_string(part.front()) +
          " belongs to a closed surface, which has no boundary (elements given twice?)");
}

void TopologyBuilder::orient_elements() {
  std::vector<signed char> flip(at(data_.element_count()), 0);
  std::vector<unsigned char> seen(at(data_.element_count()), 0);
  std::vector<Index> part;
  for (Index seed = 0; seed < data_.element_count(); ++seed) {
    if (seen[at(seed)]) continue;
    walk_part(seed, flip, seen, part);
    check_open(part);
    // The total area depends on the boundary alone, so tangled interiors do not mislead it.
    double area = 0;
    for (const Index e : part) {
      const double a = signed_area2(data_.coordinates, data_.element(e));
      area += flip[at(e)] ? -a : a;
    }
    if (area < 0) {
      for (const Index e : part) flip[at(e)] = static_cast<signed char>(!flip[at(e)]);
    }
  }
  for (Index e = 0; e < data_.element_count(); ++e) {
    if (!flip[at(e)]) continue;
    const auto begin = topology_->elements_.values.begin() + data_.element_offsets[at(e)];
    const auto end = topology_->elements_.values.begin() + data_.element_offsets[at(e) + 1];
    std::reverse(begin + 1, end);
    ++topology_->reversed_;
  }
}

void TopologyBuilder::check_manifold_nodes() const {
  std::vector<Index> boundary_edges(at(data_.node_count()), 0);
  for (const auto& edge : topology_->edges_) {
    if (edge.elements[1] >= 0) continue;
    for (const Index node : edge.nodes) {
      if (++boundary_edges[at(node)] > 2) {
        throw MeshError(MeshEntity::node, node,
                        "node " + std::to_string(node) +
                            " joins parts of the mesh that meet in this node only, expected parts "
                            "to share an edge (non-manifold)");
      }
    }
  }
}

void TopologyBuilder::build_half_edges() {
  topology_->half_edges_ = std::make_unique<HalfEdgeMesh>();
  HalfEdgeMesh& mesh = *topology_->half_edges_;
  const auto edges = topology_->edges_.size();
  mesh.reserve(at(data_.node_count()), edges, at(data_.element_count()));
  for (Index i = 0; i < data_.node_count(); ++i) mesh.add_vertex();
  std::vector<OpenMesh::VertexHandle> face;
  for (Index e = 0; e < data_.element_count(); ++e) {
    face.clear();
    for (const Index node : topology_->element(e)) face.emplace_back(node);
    if (!mesh.add_face(face).is_valid()) {
      throw MeshError(MeshEntity::element, e,
                      "element " + std::to_string(e) +
                          " cannot be joined to its neighbours (non-manifold node)");
    }
  }
}

void TopologyBuilder::build_stars() {
  const HalfEdgeMesh& mesh = *topology_->half_edges_;
  auto& neighbours = topology_->neighbours_;
  auto& star = topology_->star_;
  std::vector<Index> incident(at(data_.node_count()), 0);
  for (const Index node : topology_->elements_.values) ++incident[at(node)];
  neighbours.values.reserve(2 * topology_->edges_.size());
  star.values.reserve(topology_->elements_.values.size());
  for (Index node = 0; node < data_.node_count(); ++node) {
    const auto first_row = neighbours.values.size();
    const auto first_star = star.values.size();
    const OpenMesh::VertexHandle v(node);
    if (!mesh.is_isolated(v)) {
      // OpenMesh stores an outgoing boundary half-edge, the last one counter-clockwise, so the next
      // one across the gap opens the row.
      const bool open = mesh.is_boundary(v);
      const auto next = [&](OpenMesh::HalfedgeHandle h) {
        return mesh.opposite_halfedge_handle(mesh.prev_halfedge_handle(h));
      };
      const auto start = open ? next(mesh.halfedge_handle(v)) : mesh.halfedge_handle(v);
      auto h = start;
      do {
        neighbours.values.push_back(mesh.to_vertex_handle(h).idx());
        if (!mesh.is_boundary(h)) star.values.push_back(mesh.face_handle(h).idx());
        h = next(h);
      } while (h != start);
      if (!open) {
        // A start that does not depend on the order of elements in the file.
        const auto row = neighbours.values.begin() + static_cast<std::ptrdiff_t>(first_row);
        const auto shift = std::min_element(row, neighbours.values.end()) - row;
        std::rotate(row, row + shift, neighbours.values.end());
        const auto faces = star.values.begin() + static_cast<std::ptrdiff_t>(first_star);
        std::rotate(faces, faces + shift, star.values.end());
      }
    }
    if (star.values.size() - first_star != at(incident[at(node)])) {
      throw MeshError(
          MeshEntity::node, node,
          "node " + std::to_string(node) + " has two separate stars of elements (non-manifold)");
    }
    neighbours.offsets.push_back(static_cast<Index>(neighbours.values.size()));
    star.offsets.push_back(static_cast<Index>(star.values.size()));
  }
}

void TopologyBuilder::build_loops() {
  std::vector<unsigned char> visited(at(data_.node_count()), 0);
  const auto on_boundary = [&](Index node) {
    return topology_->star(node).size() < topology_->neighbours(node).size();
  };
  for (Index seed = 0; seed < data_.node_count(); ++seed) {
    if (visited[at(seed)] || !on_boundary(seed)) continue;
    std::vector<Index> loop;
    for (Index node = seed; !visited[at(node)]; node = topology_->neighbours(node).front()) {
      visited[at(node)] = 1;
      loop.push_back(node);
    }
    topology_->loops_.push_back(std::move(loop));
  }
}

void TopologyBuilder::build_markers() {
  topology_->markers_ = data_.markers;
  topology_->markers_from_file_ = !data_.markers.empty();
  if (data_.markers.empty()) {
    for (std::size_t i = 0; i < topology_->loops_.size(); ++i) {
      const auto& loop = topology_->loops_[i];
      Marker marker{"loop_" + std::to_string(i + 1), static_cast<int>(i) + 1, {}};
      for (std::size_t k = 0; k < loop.size(); ++k) {
        marker.edges.push_back({loop[k], loop[(k + 1) % loop.size()]});
      }
      topology_->markers_.push_back(std::move(marker));
    }
  }
  std::vector<unsigned char> marked(topology_->edges_.size(), 0);
  const auto find_edge = [&](Index a, Index b) {
    const auto [low, high] = std::minmax(a, b);
    const auto& edges = topology_->edges_;
    const auto it =
        std::lower_bound(edges.begin(), edges.end(), std::array<Index, 2>{low, high},
                         [](const Topology::Edge& edge, const std::array<Index, 2>& key) {
                           return edge.nodes < key;
                         });
    const bool found = it != edges.end() && it->nodes == std::array<Index, 2>{low, high};
    return found ? static_cast<Index>(it - edges.begin()) : -1;
  };
  for (std::size_t m = 0; m < topology_->markers_.size(); ++m) {
    const Marker& marker = topology_->markers_[m];
    std::vector<Index> nodes;
    for (std::size_t k = 0; k < marker.edges.size(); ++k) {
      const auto [a, b] = marker.edges[k];
      const Index edge = find_edge(a, b);
      if (edge < 0) {
        throw MeshError(MeshEntity::marker_edge, static_cast<Index>(k),
                        "edge " + std::to_string(k) + " of marker '" + marker.name +
                            "' joins nodes " + std::to_string(a) + " and " + std::to_string(b) +
                            ", expected an edge of an element",
                        static_cast<Index>(m));
      }
      marked[at(edge)] = 1;
      nodes.push_back(a);
      nodes.push_back(b);
    }
    sort_unique(nodes);
    auto& rows = topology_->marker_nodes_;
    rows.values.insert(rows.values.end(), nodes.begin(), nodes.end());
    rows.offsets.push_back(static_cast<Index>(rows.values.size()));
  }
  for (std::size_t i = 0; i < marked.size(); ++i) {
    if (topology_->edges_[i].elements[1] < 0 && !marked[i]) ++topology_->unmarked_edges_;
  }
}

void TopologyBuilder::constrain_nodes() {
  topology_->constrained_.assign(at(data_.node_count()), 0);
  for (const auto& loop : topology_->loops_) {
    for (const Index node : loop) topology_->constrained_[at(node)] = 1;
  }
  for (const Index node : topology_->marker_nodes_.values) topology_->constrained_[at(node)] = 1;
  for (Index node = 0; node < data_.node_count(); ++node) {
    if (topology_->used(node) && !topology_->constrained(node)) {
      topology_->free_nodes_.push_back(node);
    }
  }
}

}  // namespace winslow
