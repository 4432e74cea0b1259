#include <algorithm>
#include <array>
#include <string>

#include "core/error.h"
#include "core/mesh/node_stars.h"
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

/// Sorts rows, and drops values that a row has more than once.
CompressedRows sorted_unique(CompressedRows rows) {
  std::vector<Index> counts(at(rows.rows()));
  parallel_for(0, rows.rows(), [&](Index first, Index last) {
    for (Index i = first; i < last; ++i) {
      const auto begin = rows.values.begin() + rows.offsets[at(i)];
      const auto end = rows.values.begin() + rows.offsets[at(i) + 1];
      std::sort(begin, end);
      counts[at(i)] = static_cast<Index>(std::unique(begin, end) - begin);
    }
  });
  CompressedRows out;
  out.offsets.reserve(rows.offsets.size());
  for (Index i = 0; i < rows.rows(); ++i) {
    const auto begin = rows.values.begin() + rows.offsets[at(i)];
    out.values.insert(out.values.end(), begin, begin + counts[at(i)]);
    out.end_row();
  }
  out.values.shrink_to_fit();
  return out;
}

/// Edges at which more than two boundary faces meet. Throws MeshError naming a node of one.
void check_boundary_edges(const MeshData& data, const FacePairs& pairs) {
  std::vector<std::array<Index, 2>> edges;
  for (Index f = 0; f < pairs.face_count(); ++f) {
    if (pairs.elements[at(f)][1] >= 0) continue;
    const Face face = first_face(data, pairs, f);
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
  LinkFaces(const MeshData& data, const FacePairs& pairs)
      : count(at(data.node_count()), 0), boundary(at(data.node_count()), false) {
    for (Index f = 0; f < pairs.face_count(); ++f) {
      for (const Index node : first_face(data, pairs, f)) {
        ++count[at(node)];
        if (pairs.elements[at(f)][1] < 0) boundary[at(node)] = true;
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
  LinkCheck(const MeshData& data, const FacePairs& pairs, const NodeStars& stars,
            const LinkFaces& faces)
      : data_(data),
        pairs_(pairs),
        stars_(stars),
        faces_(faces),
        reached_(at(data.element_count()), -1) {}

  void check(Index node) {
    const auto star = static_cast<Index>(stars_.elements[node].size());
    if (star == 0) return;
    const auto edges = static_cast<Index>(stars_.neighbours[node].size());
    const Index characteristic = edges - faces_.count[at(node)] + star;
    if (connected(node) == star && characteristic == (faces_.boundary[at(node)] ? 1 : 2)) return;
    throw MeshError(MeshEntity::node, node,
                    "node " + std::to_string(node) +
                        " joins parts of the mesh, or of its boundary, that meet in this node only "
                        "(non-manifold)");
  }

 private:
  /// Number of elements that can be reached from the first one of a star through faces at its node.
  Index connected(Index node) {
    const auto star = stars_.elements[node];
    todo_.assign(1, star.front());
    reached_[at(star.front())] = node;
    for (std::size_t head = 0; head < todo_.size(); ++head) {
      const Index e = todo_[head];
      const auto faces = pairs_.faces_of(e);
      for (std::size_t k = 0; k < faces.size(); ++k) {
        const auto& [first, second] = pairs_.elements[at(faces[k])];
        const Index other = first == e ? second : first;
        if (other < 0 || reached_[at(other)] == node) continue;
        const Face face = face_of_side(data_, e, static_cast<Index>(k));
        if (std::find(face.begin(), face.end(), node) == face.end()) continue;
        reached_[at(other)] = node;
        todo_.push_back(other);
      }
    }
    return static_cast<Index>(todo_.size());
  }

  const MeshData& data_;
  const FacePairs& pairs_;
  const NodeStars& stars_;
  const LinkFaces& faces_;
  std::vector<Index> reached_;  // #elements: the node from which it was reached last
  std::vector<Index> todo_;
};

}  // namespace

NodeStars volume_stars(const std::vector<ElementType>& types, const CompressedRows& elements,
                       Index node_count) {
  NodeStars stars;
  stars.elements = rows_of(node_count, [&](const auto& add) {
    for (Index e = 0; e < elements.rows(); ++e) {
      for (const Index node : elements[e]) add(node, e);
    }
  });
  stars.neighbours = sorted_unique(rows_of(node_count, [&](const auto& add) {
    for (Index e = 0; e < elements.rows(); ++e) {
      const auto corners = elements[e];
      for (const auto& [a, b] : shape_of(types[at(e)]).edges) {
        add(corners[at(a)], corners[at(b)]);
        add(corners[at(b)], corners[at(a)]);
      }
    }
  }));
  return stars;
}

void check_volume_manifold(const MeshData& data, const FacePairs& pairs, const NodeStars& stars) {
  check_boundary_edges(data, pairs);
  const LinkFaces faces(data, pairs);
  // Each block has a list of all elements: few blocks.
  constexpr Index most_blocks = 16;
  const Index block = std::max(parallel_block, data.node_count() / most_blocks + 1);
  const auto check_nodes = [&](Index begin, Index end) {
    LinkCheck check(data, pairs, stars, faces);
    for (Index node = begin; node < end; ++node) check.check(node);
  };
  parallel_for(0, data.node_count(), check_nodes, block);
}

}  // namespace winslow
