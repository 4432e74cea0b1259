#include <algorithm>
#include <array>
#include <string>

#include "core/error.h"
#include "core/mesh/node_stars.h"
#include "core/mesh/topology.h"
#include "core/parallel/parallel_for.h"

namespace winslow {

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

/// The neighbours of every node along the edges of the elements around it, ascending.
class NeighbourRows {
 public:
  NeighbourRows(const std::vector<ElementType>& types, const CompressedRows& elements,
                const CompressedRows& stars)
      : types_(types), elements_(elements), stars_(stars) {}

  CompressedRows make(std::span<const Index> order) const {
    // Found block by block of the order, and put to their places when the lengths of all are known.
    const auto nodes = static_cast<Index>(order.size());
    std::vector<std::vector<Index>> found(order.size() / block + 1);
    CompressedRows rows;
    rows.offsets.assign(order.size() + 1, 0);
    const auto own = [&](Index begin, Index end) {
      return order.subspan(at(begin), at(end - begin));
    };
    parallel_for(
        0, nodes,
        [&](Index begin, Index end) {
          auto& values = found[at(begin / block)];
          for (const Index node : own(begin, end))
            rows.offsets[at(node) + 1] = add_neighbours(node, values);
        },
        block);
    for (std::size_t i = 1; i < rows.offsets.size(); ++i) rows.offsets[i] += rows.offsets[i - 1];
    rows.values.resize(at(rows.offsets.back()));
    parallel_for(
        0, nodes,
        [&](Index begin, Index end) {
          auto value = found[at(begin / block)].cbegin();
          for (const Index node : own(begin, end)) {
            const Index first = rows.offsets[at(node)], count = rows.offsets[at(node) + 1] - first;
            std::copy_n(value, count, rows.values.begin() + first);
            value += count;
          }
        },
        block);
    return rows;
  }

 private:
  static constexpr Index block = parallel_block;

  /// Their number.
  Index add_neighbours(Index node, std::vector<Index>& values) const {
    const auto begin = static_cast<std::ptrdiff_t>(values.size());
    for (const Index e : stars_[node]) {
      const auto corners = elements_[e];
      const auto corner = std::ranges::find(corners, node) - corners.begin();
      for (const Index k : shape_of(types_[at(e)]).links[static_cast<std::size_t>(corner)])
        values.push_back(corners[at(k)]);
    }
    std::sort(values.begin() + begin, values.end());
    values.erase(std::unique(values.begin() + begin, values.end()), values.end());
    return static_cast<Index>(static_cast<std::ptrdiff_t>(values.size()) - begin);
  }

  const std::vector<ElementType>& types_;
  const CompressedRows& elements_;
  const CompressedRows& stars_;
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

/// What the nodes' links consist of.
struct LinkFaces {
  explicit LinkFaces(const Topology& topology)
      : count(at(topology.node_count()), 0), boundary(at(topology.node_count()), false) {
    for (Index f = 0; f < topology.face_count(); ++f) {
      const auto [nodes, elements] = topology.face(f);
      for (const Index node : nodes) {
        ++count[at(node)];
        if (elements[1] < 0) boundary[at(node)] = true;
      }
    }
  }

  std::vector<Index> count;  // #nodes: faces at the node
  std::vector<bool> boundary;
};

/// The link of a node (its star's outer surface) is a sphere, or on the boundary a disc, exactly if
/// it is connected and its Euler characteristic is 2, or 1.
class LinkCheck {
 public:
  LinkCheck(const Topology& topology, const FacePairs& pairs, const LinkFaces& faces)
      : topology_(topology),
        pairs_(pairs),
        faces_(faces),
        reached_(at(topology.element_count()), -1) {}

  bool holds(Index node) {
    const auto star = static_cast<Index>(topology_.star(node).size());
    if (star == 0) return true;
    const auto edges = static_cast<Index>(topology_.neighbours(node).size());
    const Index characteristic = edges - faces_.count[at(node)] + star;
    return connected(node) == star && characteristic == (faces_.boundary[at(node)] ? 1 : 2);
  }

 private:
  /// Number of elements that can be reached from the first one of a star through faces at its node.
  Index connected(Index node) {
    const auto star = topology_.star(node);
    todo_.assign(1, star.front());
    reached_[at(star.front())] = node;
    for (std::size_t head = 0; head < todo_.size(); ++head) {
      const Index e = todo_[head];
      for (const Index f : pairs_.faces_of(e)) {
        const auto [face, elements] = topology_.face(f);
        if (std::find(face.begin(), face.end(), node) == face.end()) continue;
        const Index other = elements[0] == e ? elements[1] : elements[0];
        if (other < 0 || reached_[at(other)] == node) continue;
        reached_[at(other)] = node;
        todo_.push_back(other);
      }
    }
    return static_cast<Index>(todo_.size());
  }

  const Topology& topology_;
  const FacePairs& pairs_;
  const LinkFaces& faces_;
  std::vector<Index> reached_;  // #elements: the node from which it was reached last
  std::vector<Index> todo_;
};

}  // namespace

NodeStars volume_stars(const std::vector<ElementType>& types, const CompressedRows& elements,
                       std::span<const Index> order) {
  NodeStars stars;
  stars.elements = rows_of(static_cast<Index>(order.size()), [&](const auto& add) {
    for (Index e = 0; e < elements.rows(); ++e) {
      for (const Index node : elements[e]) add(node, e);
    }
  });
  stars.neighbours = NeighbourRows(types, elements, stars.elements).make(order);
  return stars;
}

void check_volume_manifold(const Topology& topology, const FacePairs& pairs,
                           std::span<const Index> order) {
  check_boundary_edges(topology);
  const LinkFaces faces(topology);
  // Each block has a list of all elements: few blocks.
  constexpr Index most_blocks = 16;
  const auto nodes = static_cast<Index>(order.size());
  const Index block = std::max(parallel_block, nodes / most_blocks + 1);
  std::vector<Index> failed(at(nodes / block + 1), nodes);  // the lowest one of each block
  parallel_for(
      0, nodes,
      [&](Index begin, Index end) {
        LinkCheck check(topology, pairs, faces);
        Index& lowest = failed[at(begin / block)];
        for (Index k = begin; k < end; ++k) {
          const Index node = order[at(k)];
          if (node < lowest && !check.holds(node)) lowest = node;
        }
      },
      block);
  const Index node = *std::ranges::min_element(failed);
  if (node == nodes) return;
  throw MeshError(MeshEntity::node, node,
                  "node " + std::to_string(node) +
                      " joins parts of the mesh, or of its boundary, that meet in this node only "
                      "(non-manifold)");
}

}  // namespace winslow
