#pragma once

#include <array>

#include "core/geometry/tangent_frame.h"
#include "core/index.h"
#include "core/types.h"

namespace winslow {

/// The place on a curve or a surface that is nearest to a point, and how the geometry runs on from
/// there: to second order a node that moves by u_k along the directions of the frame and is put
/// back onto the geometry comes to
///
///   point + sum_k u_k frame_k + 1/2 sum_kl u_k u_l bend_kl,
///
/// bend at right angles to the frame (the curvature vector of a curve, the second fundamental form
/// of a surface). In units of the mesh, bends in 1 / that.
struct Foot {
  Vec3 point{0, 0, 0};
  TangentFrame frame;  ///< one direction of a curve, two of a surface
  std::array<Vec3, 3> bend{Vec3(0, 0, 0), Vec3(0, 0, 0), Vec3(0, 0, 0)};  ///< 11, 12, 22
};

/// What the nodes that slide slide on. It does not change while they do, and its answers depend on
/// its arguments alone.
class SlidingGeometry {
 public:
  virtual ~SlidingGeometry() = default;
  /// For a node that slides (others: UsageError), the place on its curve or surface nearest to a
  /// point. Frames of places near one another are near one another.
  virtual Foot foot(Index node, const Vec3& point) const = 0;
};

}  // namespace winslow
