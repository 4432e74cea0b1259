#include "core/mesh/node_stars.h"

#include "core/error.h"
#include "core/mesh/half_edge.h"
#include "core/mesh/topology.h"
#include "core/parallel/parallel_for.h"

namespace winslow {

namespace {

using Values = std::vector<Index>;

/// One turn around each node, counter-clockwise.
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
    // The half-edge of a boundary vertex is the last one counter-clockwise, so the next one across
    // the gap opens the row.
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
    // Boundary half-edges have the elements on their right: against them they are on the left.
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

/// Row i holds the second members of the pairs (i, value) that `each` hands to its argument twice,
/// first to count them.
template <typename Each>
CompressedRows rows_of(Index node_count, const Each& each) {
  CompressedRows rows;
  rows.offsets.assign(at(node_count) + 1, 0);
  each([&](Index row, Index) { ++rows.offsets[at(row) + 1]; });
  for (std::size_t i = 1; i < rows.offsets.size(); ++i) rows.offsets[i] += rows.offsets[i - 1];
  rows.values.resize(at(rows.offsets.back()));
  std::vector<Index> next(rows.offsets.begin(), rows.offsets.end() - 1);
  each([&](Index row, Index value) { rows.values[at(next[at(row)]++)] = value; });
  return rows;
}

/// Neighbours of nodes along the edges of the elements around them, ascending. They are found block
/// by block of the order, and put to their places when the lengths of all are known.
class NeighbourRows {
 public:
  explicit NeighbourRows(const OrderedStars& stars)
      : stars_(stars), found_(stars.order.nodes.size() / at(parallel_block) + 1) {
    rows_.offsets.assign(stars.order.nodes.size() + 1, 0);
  }

  CompressedRows make() {
    const auto nodes = static_cast<Index>(stars_.order.nodes.size());
    parallel_for(0, nodes, [&](Index begin, Index end) { find(begin, end); });
    auto& offsets = rows_.offsets;
    for (std::size_t i = 1; i < offsets.size(); ++i) offsets[i] += offsets[i - 1];
    rows_.values.resize(at(offsets.back()));
    parallel_for(0, nodes, [&](Index begin, Index end) { put(begin, end); });
    return std::move(rows_);
  }

 private:
  Index node(Index k) const { return stars_.order.nodes[at(k)]; }

  void find(Index begin, Index end) {
    std::vector<Index>& values = found_[at(begin / parallel_block)];
    for (Index k = begin; k < end; ++k) {
      const std::size_t before = values.size();
      add_neighbours(k, values);
      const auto own = values.begin() + static_cast<std::ptrdiff_t>(before);
      for (auto it = own; it != values.end(); ++it) *it = node(*it);
      std::sort(own, values.end());
      rows_.offsets[at(node(k)) + 1] = static_cast<Index>(values.size() - before);
    }
  }

  /// By their numbers in the order, each once.
  void add_neighbours(Index k, std::vector<Index>& values) const {
    const auto begin = static_cast<std::ptrdiff_t>(values.size());
    for (const Index e : stars_.elements[k]) {
      const auto corners = stars_.order.corners[e];
      const auto corner = std::ranges::find(corners, k) - corners.begin();
      for (const Index c : shape_of(stars_.types[at(e)]).links[static_cast<std::size_t>(corner)]) {
        const Index other = corners[at(c)];
        if (std::find(values.begin() + begin, values.end(), other) == values.end())
          values.push_back(other);
      }
    }
  }

  void put(Index begin, Index end) {
    auto value = found_[at(begin / parallel_block)].cbegin();
    for (Index k = begin; k < end; ++k) {
      const Index first = rows_.offsets[at(node(k))];
      const Index count = rows_.offsets[at(node(k)) + 1] - first;
      std::copy_n(value, count, rows_.values.begin() + first);
      value += count;
    }
  }

  const OrderedStars& stars_;
  std::vector<std::vector<Index>> found_;  // of blocks
  CompressedRows rows_;
};

/// Edges at which more than two boundary faces meet. Throws MeshError naming a node of one.
void check_boundary_edges(const Topology& topology) {
  std::vector<std::array<Index, 2>> edges;
  for (Index f = 0; f < topology.face_count(); ++f) {
    const auto [face, elements] = topology.face(f);
    if (elements[1] >= 0) continue;
    for (std::size_t k = 0; k < face.size(); ++k) {
      const Index a = face[k], b = face[(k + 1) % face.size()];
      edges.push_back({std::min(a, b), std::max(a, b)});
    }
  }
  std::sort(edges.begin(), edges.end());
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

/// The faces of elements at a corner of theirs, by the numbers of corners.
const std::vector<Face>& faces_at(ElementType type, std::size_t corner) {
  using OfCorners = std::vector<std::vector<Face>>;
  static const std::array<OfCorners, all_element_types.size()> all = [] {
    std::array<OfCorners, all_element_types.size()> table;
    for (const ElementType t : all_element_types) {
      OfCorners& own = table[static_cast<std::size_t>(t)];
      own.resize(at(corner_count(t)));
      for (const Face& face : shape_of(t).faces)
        for (const Index k : face) own[at(k)].push_back(face);
    }
    return table;
  }();
  return all[static_cast<std::size_t>(type)][corner];
}

/// Faces at one node, and the elements of its star that have them.
class FaceTable {
 public:
  /// Forgets all. sides: of elements at the node, at most.
  void begin(std::size_t sides) {
    while (slots_.size() < 2 * sides) {
      slots_.assign(2 * slots_.size(), {});
      --shift_;
    }
    ++round_;
  }
  /// The element, by its place in the star, that has the face, too; -1: none of those before.
  Index meet(const std::array<Index, 4>& face, Index element) {
    std::uint64_t hash = 0;
    for (const Index node : face)
      hash = (hash ^ static_cast<std::uint32_t>(node)) * 0x9E3779B97F4A7C15U;
    std::size_t k = hash >> shift_;
    for (; slots_[k].round == round_; k = (k + 1) & (slots_.size() - 1))
      if (slots_[k].face == face) return slots_[k].element;
    slots_[k] = {face, element, round_};
    return -1;
  }

 private:
  struct Slot {
    std::array<Index, 4> face{};
    Index element = -1;
    Index round = 0;  // others are of nodes before
  };
  std::vector<Slot> slots_ = std::vector<Slot>(256);
  unsigned shift_ = 56;  // 64 less the bits of a place
  Index round_ = 0;
};

/// The link of a node (its star's outer surface) is a sphere, or on the boundary a disc, exactly if
/// it is connected and its Euler characteristic is 2, or 1.
class LinkCheck {
 public:
  explicit LinkCheck(const OrderedStars& stars) : stars_(stars) {}

  /// node: by its number in the order; edges: at it.
  bool holds(Index node, Index edges) {
    constexpr std::size_t most_faces = 4;  // of an element at a corner
    const auto star = stars_.elements[node];
    const auto count = static_cast<Index>(star.size());
    if (count == 0) return true;
    faces_.begin(most_faces * star.size());
    joined_.resize(star.size());
    std::iota(joined_.begin(), joined_.end(), 0);
    Index faces = 0, open = 0, parts = count;
    for (Index place = 0; place < count; ++place) {
      const Index e = star[at(place)];
      const auto corners = stars_.order.corners[e];
      const auto corner = std::ranges::find(corners, node) - corners.begin();
      for (const Face& face : faces_at(stars_.types[at(e)], static_cast<std::size_t>(corner))) {
        const Index other = faces_.meet(by_nodes(face, corners).sorted(), place);
        faces += other < 0 ? 1 : 0;
        open += other < 0 ? 1 : -1;
        if (other >= 0 && join(other, place)) --parts;
      }
    }
    return parts == 1 && edges - faces + count == (open > 0 ? 1 : 2);
  }

 private:
  Index root(Index place) {
    while (joined_[at(place)] != place)
      place = joined_[at(place)] = joined_[at(joined_[at(place)])];
    return place;
  }
  /// False: they were joined before.
  bool join(Index a, Index b) {
    const Index from = root(a), to = root(b);
    joined_[at(from)] = to;
    return from != to;
  }

  const OrderedStars& stars_;
  FaceTable faces_;
  std::vector<Index> joined_;  // elements of the star: towards one for all that hang together
};

}  // namespace

CompressedRows star_rows(const CompressedRows& elements, Index node_count) {
  return rows_of(node_count, [&](const auto& add) {
    for (Index e = 0; e < elements.rows(); ++e) {
      for (const Index node : elements[e]) add(node, e);
    }
  });
}

OrderedStars::OrderedStars(const MeshData& data, const CompressedRows& corners)
    : order(SpacePoints(data.coordinates), data.node_count(), box_around(data.coordinates),
            corners),
      elements(star_rows(order.corners, data.node_count())) {
  types.reserve(order.elements.size());
  for (const Index e : order.elements) types.push_back(data.types[at(e)]);
}

CompressedRows volume_neighbours(const OrderedStars& stars) { return NeighbourRows(stars).make(); }

void check_volume_manifold(const Topology& topology, const OrderedStars& stars) {
  check_boundary_edges(topology);
  const Index nodes = topology.node_count();
  std::vector<Index> failed(at(nodes / parallel_block + 1), nodes);  // the lowest one of each block
  parallel_for(0, nodes, [&](Index begin, Index end) {
    LinkCheck check(stars);
    Index& lowest = failed[at(begin / parallel_block)];
    for (Index k = begin; k < end; ++k) {
      const Index node = stars.order.nodes[at(k)];
      const auto edges = static_cast<Index>(topology.neighbours(node).size());
      if (node < lowest && !check.holds(k, edges)) lowest = node;
    }
  });
  const Index node = *std::ranges::min_element(failed);
  if (node == nodes) return;
  throw MeshError(MeshEntity::node, node,
                  "node " + std::to_string(node) +
                      " joins parts of the mesh, or of its boundary, that meet in this node only "
                      "(non-manifold)");
}

}  // namespace winslow
