#include "core/mesh/face_pairs.h"

#include <tuple>

#include "core/error.h"
#include "core/mesh/element_type.h"
#include "core/parallel/parallel_for.h"
#include "core/search/box_tree.h"

namespace winslow {

namespace {

/// A side without its lowest node, which SortedSides knows. N: largest number of nodes of a face.
template <std::size_t N>
struct Side {
  std::array<Index, N - 1> others;  // ascending
  Index side, element;
  bool ascends;  // of the whole side

  bool operator<(const Side& other) const {
    return std::tie(others, side) < std::tie(other.others, other.side);
  }
};

/// Whether the node after the lowest node is lower than the one before it. This differs for faces
/// with the same nodes in opposite directions.
bool ascends(const Face& face) {
  const std::size_t n = face.size();
  const auto low =
      static_cast<std::size_t>(std::min_element(face.begin(), face.end()) - face.begin());
  return n == 2 ? low == 0 : face[(low + 1) % n] < face[(low + n - 1) % n];
}

/// Whether two faces with the same nodes have the same diagonals.
bool same_diagonals(const Face& a, const Face& b) {
  if (a.size() < 4) return true;
  return b[(index_of(b, a[0]) + 2) % 4] == a[2];
}

/// Calls body(nodes, element) for every side of every element.
template <typename Body>
void for_each_side(const MeshData& data, const Body& body) {
  for (Index e = 0; e < data.element_count(); ++e) {
    const auto corners = data.element(e);
    for (const Face& face : shape_of(data.types[at(e)]).faces) body(by_nodes(face, corners), e);
  }
}

/// The sides of all elements, sorted: a bucket for each lowest node, which few sides share.
template <std::size_t N>
struct SortedSides {
  explicit SortedSides(const MeshData& data) : begin(at(data.node_count()) + 2, 0) {
    for_each_side(data, [&](const Face& nodes, Index) {
      ++begin[at(*std::min_element(nodes.begin(), nodes.end())) + 2];
    });
    std::partial_sum(begin.begin(), begin.end(), begin.begin());
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
  data.kind() == MeshKind::volume ? pair_sides<4>(data, pairs) : pair_sides<2>(data, pairs);
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

namespace {

/// Orients the elements of each connected part, from neighbour to neighbour.
class Walk {
 public:
  Walk(const MeshData& data, const FacePairs& pairs)
      : data_(data),
        pairs_(pairs),
        turn_(at(data.element_count()), false),
        seen_(at(data.element_count()), false) {}

  std::vector<bool> run() {
    for (Index seed = 0; seed < data_.element_count(); ++seed) {
      if (seen_[at(seed)]) continue;
      walk_part(seed);
      if (data_.kind() == MeshKind::surface) continue;
      check_open();
      if (measure() < 0) {
        for (const Index e : part_) turn_[at(e)] = !turn_[at(e)];
      }
    }
    return std::move(turn_);
  }

 private:
  void walk_part(Index seed) {
    part_.assign(1, seed);
    seen_[at(seed)] = true;
    for (std::size_t head = 0; head < part_.size(); ++head) {
      const Index e = part_[head];
      const auto faces = pairs_.faces_of(e);
      for (std::size_t k = 0; k < faces.size(); ++k) {
        const auto& [first, second] = pairs_.elements[at(faces[k])];
        const Index other = first == e ? second : first;
        if (other >= 0 && other != e) visit(e, k, other);
      }
    }
  }

  /// Orients the neighbour of an element beyond its face k.
  void visit(Index e, std::size_t k, Index other) {
    const Facing facing = pairs_.facing[at(pairs_.faces_of(e)[k])];
    if (facing == Facing::twisted)
      refuse_twisted(e, other, face_of_side(data_, e, static_cast<Index>(k)));
    const bool wanted = facing == Facing::same ? !turn_[at(e)] : turn_[at(e)];
    if (!seen_[at(other)]) {
      seen_[at(other)] = true;
      turn_[at(other)] = wanted;
      part_.push_back(other);
    } else if (turn_[at(other)] != wanted) {
      throw MeshError(MeshEntity::element, other,
                      "element " + std::to_string(other) +
                          " cannot be oriented like its neighbours (the " + domain() +
                          " is one-sided)");
    }
  }

  std::string domain() const { return std::string(words_of(data_.kind()).domain); }

  [[noreturn]] static void refuse_twisted(Index e, Index other, const Face& face) {
    throw MeshError(MeshEntity::element, other,
                    "element " + std::to_string(other) + " joins the corners of the face with " +
                        nodes_text(face) + " in another order than element " + std::to_string(e));
  }

  void check_open() const {
    for (const Index e : part_) {
      for (const Index face : pairs_.faces_of(e)) {
        if (pairs_.elements[at(face)][1] < 0) return;
      }
    }
    throw MeshError(MeshEntity::element, part_.front(),
                    "element " + std::to_string(part_.front()) + " belongs to a closed " +
                        domain() + ", which has no boundary (elements given twice?)");
  }

  /// Total area or volume of the part, times a constant. It depends on the boundary alone, since
  /// contributions of interior faces cancel.
  double measure() const {
    const Coordinates& x = data_.coordinates;
    double sum = 0;
    for (const Index e : part_) {
      const auto corners = data_.element(e);
      const double own = data_.kind() == MeshKind::plane
                             ? signed_area2(x, corners)
                             : signed_volume6(x, data_.types[at(e)], corners,
                                              x.xyz(data_.element(part_.front())[0]));
      sum += turn_[at(e)] ? -own : own;
    }
    return sum;
  }

  const MeshData& data_;
  const FacePairs& pairs_;
  std::vector<bool> turn_, seen_;
  std::vector<Index> part_;
};

/// Whether all volume elements are oriented like their neighbours and have certainly positive
/// volumes. Then no element is to be turned, and no part is closed: the volumes of a closed part
/// would cancel.
bool positive_throughout(const MeshData& data, const FacePairs& pairs) {
  if (data.kind() != MeshKind::volume) return false;
  if (!std::ranges::all_of(pairs.facing, [](Facing f) { return f == Facing::opposite; }))
    return false;
  const SpacePoints x(data.coordinates);
  std::atomic<bool> positive = true;
  parallel_for(0, data.element_count(), [&](Index begin, Index end) {
    for (Index e = begin; e < end && positive; ++e) {
      const auto corners = data.element(e);
      Box<3> box = Box<3>::empty();
      for (const Index node : corners) box.add(x[node]);
      const double size = box.size().maxCoeff();
      constexpr double certain = 1e-12;  // orders of magnitude above round-off
      const double volume =
          signed_volume6(data.coordinates, data.types[at(e)], corners, x[corners[0]]);
      if (!(volume > certain * size * size * size)) positive = false;
    }
  });
  return positive;
}

}  // namespace

std::vector<bool> elements_to_turn(const MeshData& data, const FacePairs& pairs) {
  // Most meshes are oriented already, and this check is far faster than a walk.
  if (positive_throughout(data, pairs)) return std::vector<bool>(at(data.element_count()), false);
  return Walk(data, pairs).run();
}

std::vector<Index> turned_elements(const MeshData& data, const std::vector<bool>& turn) {
  std::vector<Index> nodes = data.element_nodes;
  for (Index e = 0; e < data.element_count(); ++e) {
    if (!turn[at(e)]) continue;
    const auto corners = data.element(e);
    const auto mirrored = shape_of(data.types[at(e)]).mirrored;
    const std::size_t begin = at(data.element_offsets[at(e)]);
    for (std::size_t k = 0; k < corners.size(); ++k) nodes[begin + k] = corners[at(mirrored[k])];
  }
  return nodes;
}

}  // namespace winslow
