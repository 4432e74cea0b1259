#include "core/mesh/face_pairs.h"

#include <algorithm>
#include <string>
#include <tuple>

#include "core/error.h"
#include "core/parallel/parallel_for.h"

namespace winslow {

namespace {

/// A side but for its lowest node. N: most nodes of a face.
template <std::size_t N>
struct Side {
  std::array<Index, N - 1> others;  // ascending
  Index side, element;
  bool ascends;  // of the whole side

  bool operator<(const Side& other) const {
    return std::tie(others, side) < std::tie(other.others, other.side);
  }
};

/// Does the face run from its lowest node on towards the lower of the two beside it? Faces with the
/// same nodes in opposite directions disagree.
bool ascends(const Face& face) {
  const std::size_t n = face.size();
  const auto low =
      static_cast<std::size_t>(std::min_element(face.begin(), face.end()) - face.begin());
  return n == 2 ? low == 0 : face[(low + 1) % n] < face[(low + n - 1) % n];
}

/// Do two faces with the same nodes have the same diagonals?
bool same_diagonals(const Face& a, const Face& b) {
  if (a.size() < 4) return true;
  const auto place = static_cast<std::size_t>(std::find(b.begin(), b.end(), a[0]) - b.begin());
  return b[(place + 2) % 4] == a[2];
}

/// Calls body(nodes, element) for every side of every element.
template <typename Body>
void for_each_side(const MeshData& data, const Body& body) {
  for (Index e = 0; e < data.element_count(); ++e) {
    const auto corners = data.element(e);
    for (const Face& face : shape_of(data.types[at(e)]).faces) body(by_nodes(face, corners), e);
  }
}

/// The sides of all elements, dealt out by their lowest node, of which few have the same, and there
/// in ascending order.
template <std::size_t N>
struct SortedSides {
  explicit SortedSides(const MeshData& data) : begin(at(data.node_count()) + 2, 0) {
    for_each_side(data, [&](const Face& nodes, Index) {
      ++begin[at(*std::min_element(nodes.begin(), nodes.end())) + 2];
    });
    for (std::size_t i = 2; i < begin.size(); ++i) begin[i] += begin[i - 1];
    sides.resize(at(begin.back()));
    Index side = 0;
    for_each_side(data, [&](const Face& nodes, Index e) {
      if constexpr (N == 2) {
        const auto [low, high] = std::minmax({nodes[0], nodes[1]});
        put(low, {{high}, side++, e, low == nodes[0]});
      } else {
        const auto [low, a, b, c] = nodes.sorted();
        put(low, {{a, b, c}, side++, e, ascends(nodes)});
      }
    });
    begin.pop_back();
    parallel_for(0, data.node_count(), [&](Index first, Index last) {
      for (Index node = first; node < last; ++node) {
        const auto own = at_node(node);
        std::sort(own.begin(), own.end());
      }
    });
  }

  std::span<Side<N>> at_node(Index node) {
    return {sides.begin() + begin[at(node)], sides.begin() + begin[at(node) + 1]};
  }

  std::vector<Index> begin;  // #nodes + 1
  std::vector<Side<N>> sides;

 private:
  void put(Index low, const Side<N>& side) { sides[at(begin[at(low) + 1]++)] = side; }
};

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
Facing facing(const MeshData& data, const FacePairs& pairs, const Side<N>& a, const Side<N>& b) {
  if constexpr (N > 2) {
    const auto face = [&](const Side<N>& side) {
      return face_of_side(data, side.element, side.side - pairs.side_offsets[at(side.element)]);
    };
    const bool quadrilateral = a.others.back() >= 0;
    if (quadrilateral && !same_diagonals(face(a), face(b))) return Facing::twisted;
  }
  return a.ascends == b.ascends ? Facing::same : Facing::opposite;
}

template <std::size_t N>
void pair_sides(const MeshData& data, FacePairs& pairs) {
  SortedSides<N> sorted(data);
  const std::size_t count = sorted.sides.size();
  pairs.face_of_side.assign(count, -1);
  pairs.first_side.reserve(count / 2);
  pairs.elements.reserve(count / 2);
  pairs.facing.reserve(count / 2);
  for (Index node = 0; node < data.node_count(); ++node) {
    const auto sides = sorted.at_node(node);
    for (std::size_t i = 0; i < sides.size();) {
      std::size_t j = i + 1;
      while (j < sides.size() && sides[j].others == sides[i].others) ++j;
      if (j - i > 2) refuse(data, pairs, sides[i + 2], j - i);
      const bool paired = j - i == 2;
      const Index face = pairs.face_count();
      pairs.first_side.push_back(sides[i].side);
      pairs.elements.push_back({sides[i].element, paired ? sides[i + 1].element : -1});
      pairs.facing.push_back(paired ? facing(data, pairs, sides[i], sides[i + 1])
                                    : Facing::opposite);
      for (; i < j; ++i) pairs.face_of_side[at(sides[i].side)] = face;
    }
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
