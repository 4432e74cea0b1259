#pragma once

#include <memory>
#include <vector>

#include "core/geometry/sliding_geometry.h"

namespace winslow {

/// A geometry that remembers the last two feet of each node: a step of a solver asks for those of
/// the mesh that it starts from and of the one that it tries many times over, and a search in a
/// triangulation takes long. The foot of a place that is a foot itself is that foot, bit by bit.
///
/// Different nodes may be asked about at the same time, one node by one thread only: it belongs to
/// one run.
class RememberedFeet final : public SlidingGeometry {
 public:
  RememberedFeet(std::shared_ptr<const SlidingGeometry> geometry, Index node_count)
      : geometry_(std::move(geometry)), memory_(at(node_count)) {}

  Foot foot(Index node, const Vec3& point) const override;

 private:
  struct Place {
    Vec3 asked_for{0, 0, 0};
    Foot foot;
    bool known = false;
  };
  struct Memory {
    std::array<Place, 2> places;
    std::size_t last = 0;  // the one that was asked for last
  };

  std::shared_ptr<const SlidingGeometry> geometry_;
  mutable std::vector<Memory> memory_;
};

}  // namespace winslow
