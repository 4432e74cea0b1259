#include "core/mesh/node_stars.h"

#include <utility>

#include "core/error.h"
#include "core/mesh/half_edge.h"
#include "core/mesh/topology.h"
#include "core/parallel/parallel_for.h"

namespace winslow {

namespace {

/// The 21 bits of a number, two zeros after each.
std::uint64_t spread_bits(std::uint64_t bits) {
  bits = (bits | bits << 32U) & 0x1f00000000ffffU;
  bits = (bits | bits << 16U) & 0x1f0000ff0000ffU;
  bits = (bits | bits << 8U) & 0x100f00f00f00f00fU;
  bits = (bits | bits << 4U) & 0x10c30c30c30c30c3U;
  return (bits | bits << 2U) & 0x1249249249249249U;
}

std::vector<Index> along_curve(const SpacePoints& x, Index node_count, const Box<3>& box) {
  constexpr double cells = (1U << 21U) - 1;
  const double unit = cells / std::max(box.size().maxCoeff(), 1e-300);
  std::vector<std::pair<std::uint64_t, Index>> codes(at(node_count));
  parallel_for(0, node_count, [&](Index begin, Index end) {
    for (Index i = begin; i < end; ++i) {
      const Vec3 cell = (x[i] - box.min) * unit;
      const auto bits = [&](Index k) {
        // NaN, which an infinite box gives, becomes 0.
        const double number = cell[k] > 0 ? std::min(cell[k], cells) : 0;
        return spread_bits(static_cast<std::uint64_t>(number));
      };
      codes[at(i)] = {bits(0) | bits(1) << 1U | bits(2) << 2U, i};
    }
  });
  std::ranges::sort(codes);
  std::vector<Index> nodes;
  nodes.reserve(codes.size());
  for (const auto& [code, node] : codes) nodes.push_back(node);
  return nodes;
}

/// Elements ordered by the first of their nodes in the order; places: of the nodes in the order.
std::vector<Index> by_first_node(const CompressedRows& corners, const std::vector<Index>& places) {
  std::vector<Index> first(at(corners.rows()));
  parallel_for(0, corners.rows(), [&](Index begin, Index end) {
    for (Index e = begin; e < end; ++e) {
      Index least = static_cast<Index>(places.size());
      for (const Index node : corners[e]) least = std::min(least, places[at(node)]);
      first[at(e)] = least;
    }
  });
  return rows_of(static_cast<Index>(places.size()),
                 [&](const auto& add) {
                   for (std::size_t e = 0; e < first.size(); ++e)
                     add(first[e], static_cast<Index>(e));
                 })
      .values;
}

}  // namespace

CurveOrder::CurveOrder(const SpacePoints& x, Index node_count, const Box<3>& box,
                       const CompressedRows& of_mesh)
    : nodes(along_curve(x, node_count, box)) {
  std::vector<Index> places(nodes.size());
  for (std::size_t k = 0; k < nodes.size(); ++k) places[at(nodes[k])] = static_cast<Index>(k);
  elements = by_first_node(of_mesh, places);
  corners.offsets.reserve(elements.size() + 1);
  for (const Index e : elements)  // as many corners as in the mesh
    corners.offsets.push_back(corners.offsets.back() + static_cast<Index>(of_mesh[e].size()));
  corners.values.resize(at(corners.offsets.back()));
  parallel_for(0, corners.rows(), [&](Index begin, Index end) {
    for (Index e = begin; e < end; ++e) {
      auto value = corners.values.begin() + corners.offsets[at(e)];
      for (const Index node : of_mesh[elements[at(e)]]) *value++ = places[at(node)];
    }
  });
}

namespace {

using Values = std::vector<Index>;

/// Walks around each node, counter-clockwise.
class StarWalk {
 public:
  explicit StarWalk(const HalfEdgeMesh& mesh) : mesh_(mesh) {
    stars_.neighbours.offsets.reserve(mesh.n_vertices() + 1);
    stars_.neighbours.values.reserve(2 * mesh.n_edges());
    stars_.elements.offsets.reserve(mesh.n_vertices() + 1);
    stars_.elements.values.reserve(2 * mesh.n_edges());
  }

  NodeStars run() {
    for (const OpenMesh::VertexHandle v : mesh_.vertices()) {
      if (!mesh_.is_isolated(v)) turn(v);
      stars_.neighbours.end_row();
      stars_.elements.end_row();
    }
    return std::move(stars_);
  }

 private:
  OpenMesh::HalfedgeHandle next(OpenMesh::HalfedgeHandle h) const {
    return mesh_.opposite_halfedge_handle(mesh_.prev_halfedge_handle(h));
  }

  void turn(OpenMesh::VertexHandle v) {
    // The half-edge of a boundary vertex is its last one counter-clockwise; the next one is the
    // first of the row.
    const auto own = mesh_.halfedge_handle(v);
    const auto start = mesh_.is_boundary(own) ? next(own) : own;
    auto h = start;
    do {
      stars_.neighbours.values.push_back(mesh_.to_vertex_handle(h).idx());
      if (!mesh_.is_boundary(h)) stars_.elements.values.push_back(mesh_.face_handle(h).idx());
      h = next(h);
    } while (h != start);
  }

  const HalfEdgeMesh& mesh_;
  NodeStars stars_;
};

}  // namespace

NodeStars surface_stars(const HalfEdgeMesh& mesh, const CompressedRows& elements) {
  NodeStars stars = StarWalk(mesh).run();
  Values incident(mesh.n_vertices(), 0);
  for (const Index node : elements.values) ++incident[at(node)];
  for (Index node = 0; node < stars.elements.rows(); ++node) {
    if (stars.elements[node].size() == at(incident[at(node)])) continue;
    throw MeshError(
        MeshEntity::node, node,
        "node " + std::to_string(node) + " has two separate stars of elements (non-manifold)");
  }
  return stars;
}

std::vector<std::vector<Index>> boundary_loops(const HalfEdgeMesh& mesh) {
  std::vector<bool> visited(mesh.n_vertices(), false);
  std::vector<std::vector<Index>> loops;
  for (const OpenMesh::VertexHandle seed : mesh.vertices()) {
    if (mesh.is_isolated(seed) || !mesh.is_boundary(seed) || visited[at(seed.idx())]) continue;
    std::vector<Index> loop;
    // Boundary half-edges have the elements on their right, so the walk is against them.
    const auto start = mesh.halfedge_handle(seed);
    auto h = start;
    do {
      const Index node = mesh.from_vertex_handle(h).idx();
      visited[at(node)] = true;
      loop.push_back(node);
      h = mesh.prev_halfedge_handle(h);
    } while (h != start);
    loops.push_back(std::move(loop));
  }
  return loops;
}

void check_surface_manifold(const MeshData& data, const FacePairs& pairs) {
  Values boundary_edges(at(data.node_count()), 0);
  for (Index f = 0; f < pairs.face_count(); ++f) {
    if (pairs.elements[at(f)][1] >= 0) continue;
    const auto [a, b] = first_face(data, pairs, f).edge();
    for (const Index node : {std::min(a, b), std::max(a, b)}) {
      if (++boundary_edges[at(node)] > 2) {
        throw MeshError(MeshEntity::node, node,
                        "node " + std::to_string(node) +
                            " joins parts of the mesh that meet in this node only, expected parts "
                            "to share an edge (non-manifold)");
      }
    }
  }
}

namespace {

/// Neighbours of nodes along the edges of the elements around them, ascending. find() collects them
/// block by block of the order; put() copies them into the rows when all lengths are known.
class NeighbourRows {
 public:
  explicit NeighbourRows(const OrderedStars& stars)
      : stars_(stars),
        block_(few_blocks(static_cast<Index>(stars.order.nodes.size()))),
        found_(block_count(static_cast<Index>(stars.order.nodes.size()), block_)) {
    rows_.offsets.assign(stars.order.nodes.size() + 1, 0);
  }

  CompressedRows make() {
    const auto nodes = static_cast<Index>(stars_.order.nodes.size());
    parallel_for(
        0, nodes, [&](Index begin, Index end) { find(begin, end); }, block_);
    add_up(rows_.offsets, "neighbours of nodes");
    rows_.values.resize(at(rows_.offsets.back()));
    parallel_for(
        0, nodes, [&](Index begin, Index end) { put(begin, end); }, block_);
    return std::move(rows_);
  }

 private:
  Index node(Index k) const { return stars_.order.nodes[at(k)]; }

  void find(Index begin, Index end) {
    std::vector<Index>& values = found_[at(begin / block_)];
    std::vector<Index> seen(stars_.order.nodes.size(), -1);  // the last node that had each
    for (Index k = begin; k < end; ++k) {
      const std::size_t before = values.size();
      add_neighbours(k, seen, values);
      const auto own = values.begin() + static_cast<std::ptrdiff_t>(before);
      for (auto it = own; it != values.end(); ++it) *it = node(*it);
      std::sort(own, values.end());
      rows_.offsets[at(node(k)) + 1] = static_cast<Index>(values.size() - before);
    }
  }

  /// Adds each neighbour once, by its number in the order.
  void add_neighbours(Index k, std::vector<Index>& seen, std::vector<Index>& values) const {
    for (const Index e : stars_.elements[k]) {
      const auto corners = stars_.order.corners[e];
      const auto add = [&](Index other) {
        if (std::exchange(seen[at(other)], k) != k) values.push_back(other);
      };
      if (stars_.types[at(e)] == ElementType::tetrahedron) {
        for (const Index other : corners)
          if (other != k) add(other);
        continue;
      }
      for (const Index c : stars_.shape(e).links[index_of(corners, k)]) add(corners[at(c)]);
    }
  }

  void put(Index begin, Index end) {
    std::vector<Index>& values = found_[at(begin / block_)];
    auto value = values.cbegin();
    for (Index k = begin; k < end; ++k) {
      const Index first = rows_.offsets[at(node(k))];
      const Index count = rows_.offsets[at(node(k)) + 1] - first;
      std::copy_n(value, count, rows_.values.begin() + first);
      value += count;
    }
    values = {};  // frees memory
  }

  const OrderedStars& stars_;
  Index block_;                            // size of the blocks of nodes
  std::vector<std::vector<Index>> found_;  // of blocks
  CompressedRows rows_;
};

/// Throws MeshError naming a node of an edge at which more than two boundary faces meet.
void check_boundary_edges(const Topology& topology) {
  std::vector<std::array<Index, 2>> edges;
  for_boundary_faces(topology, [&](Index, const Topology::SharedFace& face) {
    const Face& nodes = face.nodes;
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      const auto [low, high] = std::minmax({nodes[k], nodes[(k + 1) % nodes.size()]});
      edges.push_back({low, high});
    }
  });
  std::ranges::sort(edges);
  for (std::size_t i = 2; i < edges.size(); ++i) {
    if (edges[i] != edges[i - 2]) continue;
    throw MeshError(MeshEntity::node, edges[i][0],
                    "the edge between nodes " + std::to_string(edges[i][0]) + " and " +
                        std::to_string(edges[i][1]) +
                        " joins parts of the mesh that meet in this edge only, expected parts to "
                        "share a face (non-manifold)");
  }
}

Box<3> box_around(const Coordinates& coordinates) {
  const SpacePoints x(coordinates);
  Box<3> box = Box<3>::empty();
  for (Index i = 0; i < coordinates.size(); ++i) box.add(x[i]);
  return box;
}

/// Calls visit(face) with the number of each face of an element at one of its corners.
template <typename Visit>
void for_faces_at(const ElementShape& shape, std::size_t corner, const Visit& visit) {
  static const auto all = table_by_type([](ElementType of) {
    std::vector<std::vector<Index>> at_corners(at(corner_count(of)));
    const auto faces = shape_of(of).faces;
    for (std::size_t f = 0; f < faces.size(); ++f)
      for (const Index k : faces[f]) at_corners[at(k)].push_back(static_cast<Index>(f));
    return at_corners;
  });
  if (shape.type != ElementType::polyhedron) {
    for (const Index face : all[static_cast<std::size_t>(shape.type)][corner]) visit(face);
    return;
  }
  for (std::size_t f = 0; f < shape.faces.size(); ++f)
    if (std::ranges::find(shape.faces[f], static_cast<Index>(corner)) != shape.faces[f].end())
      visit(static_cast<Index>(f));
}

/// For each face of an element that was turned inside out, the face with these nodes before. Empty
/// for polyhedra, which keep the order of their faces.
const std::vector<std::size_t>& faces_before_turn(ElementType type) {
  static const auto all = table_by_type([](ElementType of) {
    const ElementShape& shape = shape_of(of);
    std::vector<std::size_t> before;
    for (const Face& face : shape.faces) {
      const auto nodes = by_nodes(face, shape.mirrored).sorted();
      before.push_back(static_cast<std::size_t>(
          std::ranges::find(shape.faces, nodes, &Face::sorted) - shape.faces.begin()));
    }
    return before;
  });
  return all[static_cast<std::size_t>(type)];
}

/// For each element of an order the elements beyond its faces, by numbers of the order; -1 beyond
/// the boundary. turned: see check_volume_manifold().
CompressedRows elements_beside(const OrderedStars& stars, const FacePairs& pairs,
                               const std::vector<bool>& turned) {
  const std::vector<Index>& elements = stars.order.elements;
  std::vector<Index> places(elements.size());
  for (std::size_t k = 0; k < elements.size(); ++k) places[at(elements[k])] = static_cast<Index>(k);
  CompressedRows beside;
  beside.offsets.reserve(elements.size() + 1);
  for (const Index e : elements)
    beside.offsets.push_back(beside.offsets.back() + static_cast<Index>(pairs.faces_of(e).size()));
  beside.values.resize(at(beside.offsets.back()));
  parallel_for(0, beside.rows(), [&](Index begin, Index end) {
    for (Index k = begin; k < end; ++k) {
      const Index e = elements[at(k)];
      const auto& before = faces_before_turn(stars.types[at(k)]);
      auto value = beside.values.begin() + beside.offsets[at(k)];
      const auto faces = pairs.faces_of(e);
      for (std::size_t side = 0; side < faces.size(); ++side) {
        const Index face = faces[turned[at(e)] && !before.empty() ? before[side] : side];
        const auto [first, second] = pairs.elements[at(face)];
        const Index other = first == e ? second : first;
        *value++ = other < 0 ? -1 : places[at(other)];
      }
    }
  });
  return beside;
}

/// Checks that the link of a node is a sphere, or a disc on the boundary. It is if and only if the
/// link is connected and its Euler characteristic is 2, or 1 on the boundary. The parts of the link
/// are the elements of the star, its edges their faces at the node, its corners the edges there.
class LinkCheck {
 public:
  /// beside: elements_beside().
  LinkCheck(const OrderedStars& stars, const CompressedRows& beside)
      : stars_(stars), beside_(beside), seen_from_(stars.types.size(), -1) {}

  /// node: its number in the order. edges: number of edges at the node.
  bool holds(Index node, Index edges) {
    const auto star = stars_.elements[node];
    const auto count = static_cast<Index>(star.size());
    if (count == 0) return true;
    Index sides = 0, open = 0;
    // Walks from the first element through faces at the node.
    reached_.assign(1, star.front());
    seen_from_[at(star.front())] = node;
    for (std::size_t head = 0; head < reached_.size(); ++head) {
      const Index e = reached_[head];
      for_faces_at(stars_.shape(e), index_of(stars_.order.corners[e], node), [&](Index face) {
        const Index other = beside_[e][at(face)];
        ++sides;
        if (other < 0)
          ++open;
        else if (std::exchange(seen_from_[at(other)], node) != node)
          reached_.push_back(other);
      });
    }
    const Index faces = (sides + open) / 2;
    return std::ssize(reached_) == std::ssize(star) && edges - faces + count == (open > 0 ? 1 : 2);
  }

 private:
  const OrderedStars& stars_;
  const CompressedRows& beside_;
  std::vector<Index> seen_from_;  // #elements: the node from which each was reached last
  std::vector<Index> reached_;
};

}  // namespace

CompressedRows star_rows(const CompressedRows& elements, Index node_count) {
  return rows_of(node_count, [&](const auto& add) {
    for (Index e = 0; e < elements.rows(); ++e) {
      for (const Index node : elements[e]) add(node, e);
    }
  });
}

OrderedStars::OrderedStars(const MeshData& data, const Topology& of)
    : order(SpacePoints(data.coordinates), data.node_count(), box_around(data.coordinates),
            of.elements()),
      elements(star_rows(order.corners, data.node_count())),
      topology(&of) {
  types.reserve(order.elements.size());
  for (const Index e : order.elements) types.push_back(data.types[at(e)]);
}

const ElementShape& OrderedStars::shape(Index k) const {
  const ElementType type = types[at(k)];
  return type == ElementType::polyhedron ? topology->shape(order.elements[at(k)]) : shape_of(type);
}

CompressedRows volume_neighbours(const OrderedStars& stars) { return NeighbourRows(stars).make(); }

void check_volume_manifold(const Topology& topology, const OrderedStars& stars,
                           const FacePairs& pairs, const std::vector<bool>& turned) {
  // The castellated meshes of snappyHexMesh have cells that meet in an edge of a wall only.
  const bool walls_may_meet = topology.has_polyhedra();
  std::vector<bool> at_wall(at(topology.node_count()), false);
  if (walls_may_meet)
    for_boundary_faces(topology, [&](Index, const Topology::SharedFace& face) {
      for (const Index node : face.nodes) at_wall[at(node)] = true;
    });
  else
    check_boundary_edges(topology);
  const CompressedRows beside = elements_beside(stars, pairs, turned);
  const Index nodes = topology.node_count();
  const Index block = few_blocks(nodes);
  std::vector<Index> failed(at(nodes / block + 1), nodes);  // the lowest of each block
  const auto check_block = [&](Index begin, Index end) {
    LinkCheck check(stars, beside);
    Index& lowest = failed[at(begin / block)];
    for (Index k = begin; k < end; ++k) {
      const Index node = stars.order.nodes[at(k)];
      const auto edges = static_cast<Index>(topology.neighbours(node).size());
      if (node < lowest && !at_wall[at(node)] && !check.holds(k, edges)) lowest = node;
    }
  };
  parallel_for(0, nodes, check_block, block);
  const Index node = *std::ranges::min_element(failed);
  if (node == nodes) return;
  throw MeshError(MeshEntity::node, node,
                  "node " + std::to_string(node) +
                      " joins parts of the mesh, or of its boundary, that meet in this node only "
                      "(non-manifold)");
}

void check_matching_faces(const Topology& topology) {
  for_boundary_faces(topology, [&](Index, const Topology::SharedFace& face) {
    if (face.nodes.size() != 4) return;
    const auto half_from = [&](std::size_t k) {
      return Face(face.nodes[k % 4], face.nodes[(k + 1) % 4], face.nodes[(k + 2) % 4]);
    };
    for (std::size_t k = 0; k < 4; ++k) {
      const Face half = half_from(k);
      const auto triangle = topology.find_face(half);
      if (!triangle) continue;
      // Two walls of a snappy mesh may touch in half of a quadrilateral.
      if (topology.has_polyhedra() && !topology.find_face(half_from(k + 2))) continue;
      const Index e = topology.face(*triangle).elements[0];
      throw MeshError(MeshEntity::element, e,
                      "the triangle with " + nodes_text(half) + " of element " + std::to_string(e) +
                          " covers half of a quadrilateral of element " +
                          std::to_string(face.elements[0]) +
                          ", expected neighbours to share a whole face");
    }
  });
}

}  // namespace winslow
