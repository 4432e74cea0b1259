#include "core/mesh/face_pairs.h"

#include <tuple>

#include "core/error.h"
#include "core/mesh/element_type.h"
#include "core/parallel/parallel_for.h"
#include "core/search/box_tree.h"

namespace winslow {

namespace {

constexpr const char* sides_of_elements = "faces of elements";

/// N where a face has any number of nodes.
constexpr std::size_t any_number = 0;

/// A side without its lowest node, which SortedSides knows. N: largest number of nodes of a face.
template <std::size_t N>
struct Side {
  // Ascending.
  std::conditional_t<N == any_number, Face, std::array<Index, N == any_number ? 1 : N - 1>> others;
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

/// Whether two faces with the same nodes have the same edges.
bool same_edges(const Face& a, const Face& b) {
  const std::size_t n = a.size(), first = index_of(b, a[0]);
  const std::size_t step = b[(first + 1) % n] == a[1] ? 1 : n - 1;
  for (std::size_t k = 1; k < n; ++k)
    if (b[(first + k * step) % n] != a[k]) return false;
  return true;
}

/// Side k of a polygon.
Face side_of(std::span<const Index> corners, std::size_t k) {
  return {corners[k], corners[(k + 1) % corners.size()]};
}

/// Calls body(nodes, element, side) for every side of every element, on several threads.
/// side_offsets: FacePairs::side_offsets.
template <typename Body>
void for_each_side(const MeshData& data, std::span<const Index> side_offsets, const Body& body) {
  parallel_for(0, data.element_count(), [&](Index begin, Index end) {
    for (Index e = begin; e < end; ++e) {
      const auto corners = data.element(e);
      Index side = side_offsets[at(e)];
      if (data.types[at(e)] == ElementType::polyhedron) {
        for (const Face& face : data.polyhedron(e)) body(face, e, side++);
        continue;
      }
      if (data.types[at(e)] == ElementType::polygon) {
        for (std::size_t k = 0; k < corners.size(); ++k) body(side_of(corners, k), e, side++);
        continue;
      }
      for (const Face& face : shape_of(data.types[at(e)]).faces)
        body(by_nodes(face, corners), e, side++);
    }
  });
}

/// Adds 1 and returns the number before. Other threads may count at the same time.
Index count_one(Index& number) {
  return std::atomic_ref(number).fetch_add(1, std::memory_order_relaxed);
}

/// The sides of all elements, sorted: a bucket for each lowest node, which few sides share. Threads
/// fill the buckets in any order; sorting makes it one.
template <std::size_t N>
struct SortedSides {
  SortedSides(const MeshData& data, std::span<const Index> side_offsets)
      : begin(at(data.node_count()) + 2, 0), sides(at(side_offsets.back())) {
    for_each_side(data, side_offsets, [&](const Face& nodes, Index, Index) {
      count_one(begin[at(*std::min_element(nodes.begin(), nodes.end())) + 2]);
    });
    add_up(begin, sides_of_elements);
    for_each_side(data, side_offsets, [&](const Face& nodes, Index e, Index side) {
      if constexpr (N == 2) {
        const auto [low, high] = std::minmax({nodes[0], nodes[1]});
        put(low, {{high}, side, e, low == nodes[0]});
      } else if constexpr (N == any_number) {
        const Face all = nodes.sorted();
        put(all[0], {Face(std::span(all.begin() + 1, all.end())), side, e, ascends(nodes)});
      } else {
        const Face all = nodes.sorted();
        put(all[0], {{all[1], all[2], all.size() > 3 ? all[3] : -1}, side, e, ascends(nodes)});
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

  std::span<const Side<N>> at_node(Index node) const {
    return {sides.begin() + begin[at(node)], sides.begin() + begin[at(node) + 1]};
  }

  std::vector<Index> begin;  // #nodes + 1
  std::vector<Side<N>> sides;

 private:
  std::span<Side<N>> at_node(Index node) {
    return {sides.begin() + begin[at(node)], sides.begin() + begin[at(node) + 1]};
  }
  void put(Index low, Side<N> side) { sides[at(count_one(begin[at(low) + 1]))] = std::move(side); }
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
  if constexpr (N != 2) {
    const auto face = [&](const Side<N>& side) {
      return face_of_side(data, side.element, side.side - pairs.side_offsets[at(side.element)]);
    };
    const bool triangle = N == any_number ? a.others.size() == 2 : *(a.others.end() - 1) < 0;
    if (!triangle && !same_edges(face(a), face(b))) return Facing::twisted;
  }
  return a.ascends == b.ascends ? Facing::same : Facing::opposite;
}

/// Calls body(first, end) for the sides of each face, lists of one or two sides or more, at the
/// nodes [begin, end).
template <std::size_t N, typename Body>
void for_each_face(const SortedSides<N>& sorted, Index begin, Index end, const Body& body) {
  for (Index node = begin; node < end; ++node) {
    const auto sides = sorted.at_node(node);
    for (std::size_t i = 0, j = 0; i < sides.size(); i = j) {
      while (j < sides.size() && sides[j].others == sides[i].others) ++j;
      body(sides.subspan(i, j - i));
    }
  }
}

template <std::size_t N>
void pair_sides(const MeshData& data, FacePairs& pairs) {
  const SortedSides<N> sorted(data, pairs.side_offsets);
  const Index nodes = data.node_count();
  std::vector<Index> first(block_count(nodes) + 1, 0);  // face of each block of nodes
  parallel_for(0, nodes, [&](Index begin, Index end) {
    Index& count = first[at(begin / parallel_block) + 1];
    for_each_face(sorted, begin, end, [&](const auto&) { ++count; });
  });
  add_up(first, sides_of_elements);
  const std::size_t faces = at(first.back());
  pairs.face_of_side.resize(sorted.sides.size());
  pairs.first_side.resize(faces);
  pairs.elements.resize(faces);
  pairs.facing.resize(faces, Facing::opposite);
  parallel_for(0, nodes, [&](Index begin, Index end) {
    Index face = first[at(begin / parallel_block)];
    for_each_face(sorted, begin, end, [&](const auto& sides) {
      if (sides.size() > 2) refuse(data, pairs, sides[2], sides.size());
      const bool paired = sides.size() == 2;
      pairs.first_side[at(face)] = sides[0].side;
      pairs.elements[at(face)] = {sides[0].element, paired ? sides[1].element : -1};
      if (paired) pairs.facing[at(face)] = facing(data, pairs, sides[0], sides[1]);
      for (const Side<N>& side : sides) pairs.face_of_side[at(side.side)] = face;
      ++face;
    });
  });
}

}  // namespace

FacePairs pair_faces(const MeshData& data) {
  FacePairs pairs;
  pairs.side_offsets.reserve(data.types.size() + 1);
  pairs.side_offsets.push_back(0);
  for (Index e = 0; e < data.element_count(); ++e) pairs.side_offsets.push_back(data.face_count(e));
  add_up(pairs.side_offsets, sides_of_elements);
  if (data.kind() != MeshKind::volume)
    pair_sides<2>(data, pairs);
  else if (data.has_polyhedra())
    pair_sides<any_number>(data, pairs);
  else
    pair_sides<4>(data, pairs);
  return pairs;
}

Face face_of_side(const MeshData& data, Index element, Index side_of_element) {
  if (data.types[at(element)] == ElementType::polyhedron)
    return data.polyhedron(element)[at(side_of_element)];
  if (data.types[at(element)] == ElementType::polygon)
    return side_of(data.element(element), at(side_of_element));
  const ElementShape& shape = shape_of(data.types[at(element)]);
  return by_nodes(shape.faces[at(side_of_element)], data.element(element));
}

Face first_face(const MeshData& data, const FacePairs& pairs, Index face) {
  const Index element = pairs.elements[at(face)][0];
  return face_of_side(data, element, pairs.first_side[at(face)] - pairs.side_offsets[at(element)]);
}

namespace {

double volume6_of(const MeshData& data, Index e, const Vec3& origin) {
  if (data.types[at(e)] != ElementType::polyhedron)
    return signed_volume6(data.coordinates, shape_of(data.types[at(e)]), data.element(e), origin);
  double sum = 0;
  for (const Face& face : data.polyhedron(e)) sum += signed_volume6(data.coordinates, face, origin);
  return sum;
}

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
                             : volume6_of(data_, e, x.xyz(data_.element(part_.front())[0]));
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
      const double volume = volume6_of(data, e, x[corners[0]]);
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
    if (!turn[at(e)] || data.types[at(e)] == ElementType::polyhedron) continue;
    const auto corners = data.element(e);
    const std::size_t begin = at(data.element_offsets[at(e)]);
    if (data.types[at(e)] == ElementType::polygon) {
      std::reverse_copy(corners.begin() + 1, corners.end(),
                        nodes.begin() + static_cast<std::ptrdiff_t>(begin) + 1);
      continue;
    }
    const auto mirrored = shape_of(data.types[at(e)]).mirrored;
    for (std::size_t k = 0; k < corners.size(); ++k) nodes[begin + k] = corners[at(mirrored[k])];
  }
  return nodes;
}

}  // namespace winslow
