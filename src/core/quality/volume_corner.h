#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cmath>

#include "core/mesh/coordinates.h"
#include "core/mesh/corner_tetrahedra.h"
#include "core/types.h"

namespace winslow {

/// The three edges of a volume element at one of its corners.
struct VolumeCorner {
  Eigen::Matrix3d edges;  ///< columns
  double determinant;     ///< of the edges: six times the volume of the corner's tetrahedron

  VolumeCorner(const Vec3& at, const Vec3& a, const Vec3& b, const Vec3& c) {
    edges << a - at, b - at, c - at;
    determinant = edges.col(0).dot(edges.col(1).cross(edges.col(2)));
  }
  VolumeCorner(const SpacePoints& x, const std::array<Index, 4>& nodes)
      : VolumeCorner(x[nodes[0]], x[nodes[1]], x[nodes[2]], x[nodes[3]]) {}

  bool inverted() const { return !(determinant > 0); }
};

/// Signed solid angle (steradians, in (-2 pi, 2 pi]) that three edges span: negative where they are
/// inverted (A. van Oosterom and J. Strackee, IEEE Trans. Biomed. Eng. 30, 1983).
inline double solid_angle_of(const Vec3& a, const Vec3& b, const Vec3& c) {
  const double la = a.norm(), lb = b.norm(), lc = c.norm();
  return 2 * std::atan2(a.dot(b.cross(c)),
                        la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
}

}  // namespace winslow
