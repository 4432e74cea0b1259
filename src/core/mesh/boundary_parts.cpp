#include "core/mesh/boundary_parts.h"

#include <algorithm>
#include <array>
#include <numeric>

namespace winslow {

namespace {

std::vector<std::vector<Face>> loop_edges(const Topology& topology) {
  std::vector<std::vector<Face>> parts;
  for (const auto& loop : topology.boundary_loops()) {
    auto& part = parts.emplace_back();
    for (std::size_t k = 0; k < loop.size(); ++k) {
      part.emplace_back(loop[k], loop[(k + 1) % loop.size()]);
    }
  }
  return parts;
}

/// Sets of numbers that are joined pair by pair; a set is known by its lowest number.
class JoinedSets {
 public:
  explicit JoinedSets(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), Index{0});
  }
  Index find(Index i) {
    while (parent_[at(i)] != i) i = parent_[at(i)] = parent_[at(parent_[at(i)])];
    return i;
  }
  void join(Index a, Index b) {
    const auto [low, high] = std::minmax({find(a), find(b)});
    parent_[at(high)] = low;
  }

 private:
  std::vector<Index> parent_;
};

std::vector<std::vector<Face>> joined_surfaces(const std::vector<Face>& faces) {
  struct FaceEdge {
    std::array<Index, 2> nodes;
    Index face;
  };
  std::vector<FaceEdge> edges;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const Face& face = faces[f];
    for (std::size_t k = 0; k < face.size(); ++k) {
      const Index a = face[k], b = face[(k + 1) % face.size()];
      edges.push_back({{std::min(a, b), std::max(a, b)}, static_cast<Index>(f)});
    }
  }
  std::sort(edges.begin(), edges.end(),
            [](const FaceEdge& a, const FaceEdge& b) { return a.nodes < b.nodes; });
  JoinedSets sets(faces.size());
  for (std::size_t i = 1; i < edges.size(); ++i) {
    if (edges[i - 1].nodes == edges[i].nodes) sets.join(edges[i - 1].face, edges[i].face);
  }
  std::vector<std::vector<Face>> parts;
  std::vector<std::size_t> part_of(faces.size(), 0);
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const auto first = at(sets.find(static_cast<Index>(f)));
    if (first == f) {
      part_of[f] = parts.size();
      parts.emplace_back();
    }
    parts[part_of[first]].push_back(faces[f]);
  }
  return parts;
}

}  // namespace

std::vector<std::vector<Face>> boundary_parts(const Topology& topology) {
  if (topology.cell_dimension() == 2) return loop_edges(topology);
  std::vector<Face> faces;
  for (Index f = 0; f < topology.face_count(); ++f) {
    const Topology::SharedFace face = topology.face(f);
    if (face.elements[1] < 0) faces.push_back(face.nodes);
  }
  return joined_surfaces(faces);
}

}  // namespace winslow
