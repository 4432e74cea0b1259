#include "core/mesh/orientation.h"

#include <algorithm>
#include <atomic>
#include <string>

#include "core/error.h"
#include "core/mesh/element_measure.h"
#include "core/parallel/parallel_for.h"
#include "core/search/box.h"

namespace winslow {

namespace {

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
      if (data_.cell_dimension() != data_.coordinates.dimension()) continue;
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

  /// Goes from an element through its face k to the one beyond.
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
                          " cannot be oriented like its neighbours (the " +
                          (data_.cell_dimension() == 2 ? "surface" : "volume") + " is one-sided)");
    }
  }

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
                        (data_.cell_dimension() == 2 ? "surface" : "volume") +
                        ", which has no boundary (elements given twice?)");
  }

  /// Total area or volume of the part, times a constant. Interior faces cancel, so tangled
  /// interiors do not mislead it.
  double measure() const {
    const Coordinates& x = data_.coordinates;
    double sum = 0;
    for (const Index e : part_) {
      const auto corners = data_.element(e);
      const double own = data_.cell_dimension() == 2
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

/// Elements that all see their neighbours as they should, of volumes that are positive for certain:
/// none is to be turned, and no part is closed, since the volumes of a closed one cancel.
bool positive_throughout(const MeshData& data, const FacePairs& pairs) {
  if (data.cell_dimension() != 3) return false;
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
      constexpr double certain = 1e-12;  // round-off is less by orders
      const double volume =
          signed_volume6(data.coordinates, data.types[at(e)], corners, x[corners[0]]);
      if (!(volume > certain * size * size * size)) positive = false;
    }
  });
  return positive;
}

}  // namespace

std::vector<bool> elements_to_turn(const MeshData& data, const FacePairs& pairs) {
  // Most meshes are as they should be, and a walk from neighbour to neighbour takes far longer.
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
