#pragma once

#include <array>

#include "core/types.h"

namespace winslow {

/// A plane in space with a front: the side that its normal points to.
class Plane {
 public:
  /// normal: of any length but 0. Throws UsageError for one that is 0 and for what is not finite.
  Plane(const Vec3& point, const Vec3& normal);

  const Vec3& point() const { return point_; }
  const Vec3& normal() const { return normal_; }  ///< of length 1
  /// Positive in front of the plane.
  double distance(const Vec3& p) const { return normal_.dot(p - point_); }

 private:
  Vec3 point_, normal_;
};

/// Two directions of length 1 that span a plane; with its normal, to which they are at right
/// angles, they make up a right-handed frame.
std::array<Vec3, 2> directions_in(const Vec3& unit_normal);

}  // namespace winslow
