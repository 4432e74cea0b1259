#pragma once

#include <Eigen/Core>
#include <string>

#include "core/types.h"

namespace winslow {

/// A place on a surface.
struct SurfacePoint {
  Vec3 point{0, 0, 0};
  Vec3 normal{0, 0, 1};  ///< of length 1
  /// The second fundamental form: a curve on the surface that passes with velocity v, v at right
  /// angles to the normal, and no acceleration along the surface has the acceleration
  /// (v . form v) normal. Symmetric, zero along the normal, in 1/length.
  Eigen::Matrix3d form = Eigen::Matrix3d::Zero();
};

/// A surface that boundary nodes slide on.
class Surface {
 public:
  virtual ~Surface() = default;
  /// The place nearest to a point. Planes, cylinders and spheres go on beyond their faces.
  virtual SurfacePoint nearest(const Vec3& point) const = 0;
  /// Whether it goes on beyond its faces.
  virtual bool goes_on() const { return false; }
  /// "plane", "cylinder of radius 2", "sphere of radius 1", "smooth surface through 200 nodes": for
  /// reports.
  virtual std::string description() const = 0;
};

}  // namespace winslow
