#include "core/mesh/face_pairs.h"

#include <algorithm>
#include <string>
#include <tuple>

#include "core/error.h"

namespace winslow {

namespace {

/// N: most nodes of a face.
template <std::size_t N>
struct Side {
  std::array<Index, N> nodes;  // sorted
  Index side, element;

  bool operator<(const Side& other) const {
    return std::tie(nodes, side) < std::tie(other.nodes, other.side);
  }
};

template <std::size_t N>
std::array<Index, N> sorted(const Face& face) {
  if constexpr (N == 2) return {std::min(face[0], face[1]), std::max(face[0], face[1])};
  if constexpr (N == 4) return face.sorted();
}

template <std::size_t N, typename Body>
void for_each_side(const MeshData& data, const Body& body) {
  Index side = 0;
  for (Index e = 0; e < data.element_count(); ++e) {
    const auto corners = data.element(e);
    for (const Face& face : shape_of(data.types[at(e)]).faces) {
      const Face nodes = by_nodes(face, corners);
      body(Side<N>{sorted<N>(nodes), side++, e});
    }
  }
}

/// All sides in ascending order: dealt out by their lowest node, of which few sides have the same.
template <std::size_t N>
std::vector<Side<N>> sorted_sides(const MeshData& data) {
  std::vector<Index> begin(at(data.node_count()) + 1, 0);
  for_each_side<N>(data, [&](const Side<N>& side) { ++begin[at(side.nodes[0]) + 1]; });
  for (std::size_t i = 1; i < begin.size(); ++i) begin[i] += begin[i - 1];
  std::vector<Side<N>> sides(at(begin.back()));
  std::vector<Index> next(begin.begin(), begin.end() - 1);
  for_each_side<N>(data, [&](const Side<N>& side) { sides[at(next[at(side.nodes[0])]++)] = side; });
  for (std::size_t i = 0; i + 1 < begin.size(); ++i) {
    std::sort(sides.begin() + begin[i], sides.begin() + begin[i + 1]);
  }
  return sides;
}

template <std::size_t N>
[[noreturn]] void refuse(const MeshData& data, const FacePairs& pairs, const Side<N>& third,
                         std::size_t count) {
  const Face face =
      face_of_side(data, third.element, third.side - pairs.side_offsets[at(third.element)]);
  const std::string what = N == 2 ? "the edge between " : "the face with ";
  throw MeshError(MeshEntity::element, third.element,
                  what + nodes_text(face) + " is shared by " + std::to_string(count) +
                      " elements, expected at most 2 (non-manifold)");
}

template <std::size_t N>
void pair_sides(const MeshData& data, FacePairs& pairs) {
  const std::vector<Side<N>> sides = sorted_sides<N>(data);
  pairs.face_of_side.assign(sides.size(), -1);
  pairs.first_side.reserve(sides.size() / 2);
  pairs.elements.reserve(sides.size() / 2);
  for (std::size_t i = 0; i < sides.size();) {
    std::size_t j = i + 1;
    while (j < sides.size() && sides[j].nodes == sides[i].nodes) ++j;
    if (j - i > 2) refuse(data, pairs, sides[i + 2], j - i);
    const Index face = pairs.face_count();
    pairs.first_side.push_back(sides[i].side);
    pairs.elements.push_back({sides[i].element, j - i == 2 ? sides[i + 1].element : -1});
    for (; i < j; ++i) pairs.face_of_side[at(sides[i].side)] = face;
  }
}

}  // namespace

FacePairs pair_faces(const MeshData& data) {
  FacePairs pairs;
  pairs.side_offsets.reserve(data.types.size() + 1);
  pairs.side_offsets.push_back(0);
  for (const ElementType type : data.types) {
    const auto count = static_cast<Index>(shape_of(type).faces.size());
    pairs.side_offsets.push_back(pairs.side_offsets.back() + count);
  }
  if (data.cell_dimension() == 2) {
    pair_sides<2>(data, pairs);
  } else {
    pair_sides<4>(data, pairs);
  }
  return pairs;
}

Face face_of_side(const MeshData& data, Index element, Index side_of_element) {
  const ElementShape& shape = shape_of(data.types[at(element)]);
  return by_nodes(shape.faces[at(side_of_element)], data.element(element));
}

Face first_face(const MeshData& data, const FacePairs& pairs, Index face) {
  const Index element = pairs.elements[at(face)][0];
  return face_of_side(data, element, pairs.first_side[at(face)] - pairs.side_offsets[at(element)]);
}

}  // namespace winslow
