#pragma once

#include <memory>
#include <span>
#include <vector>

#include "core/geometry/boundary_kinds.h"
#include "core/geometry/curve.h"
#include "core/geometry/surface/surface.h"

namespace winslow {

/// Surfaces and curves of space, and which of them each node slides on.
class SpaceGeometry final : public SlidingGeometry {
 public:
  Foot foot(Index node, const Vec3& point) const override;

  /// x: of all nodes, near the surface.
  void add(std::shared_ptr<const Surface> surface, std::span<const Index> nodes,
           const SpacePoints& x);
  void add(std::shared_ptr<const SpaceCurve> curve, std::span<const Index> nodes);

 private:
  struct Piece {
    std::shared_ptr<const Surface> surface;
    std::shared_ptr<const SpaceCurve> curve;
  };

  struct Slider {
    Index piece;
    Vec3 direction;  // that the first of its frame is to be near to
  };

  std::vector<Piece> pieces_;
  std::vector<Slider> sliders_;
  NodeParts numbers_;  // of the sliders
};

}  // namespace winslow
