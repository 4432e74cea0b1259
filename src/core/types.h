#pragma once

#include <Eigen/Core>

#include "core/index.h"

namespace winslow {

/// A point or a vector of the plane (D = 2) or of space (D = 3).
template <int D>
using Vec = Eigen::Matrix<double, D, 1>;
using Vec2 = Vec<2>;
using Vec3 = Vec<3>;

/// The third component of the cross product of two vectors of the plane: the signed area of the
/// parallelogram that they span.
inline double cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }
/// Angle from one vector of the plane counter-clockwise to another, radians in (-pi, pi].
inline double turn_between(const Vec2& from, const Vec2& to) {
  return std::atan2(cross(from, to), from.dot(to));
}

inline constexpr double pi = 3.14159265358979323846;

/// Radians of an angle given in degrees.
constexpr double radians(double degrees) { return degrees * (pi / 180.0); }
/// Degrees of an angle given in radians.
constexpr double degrees(double radians) { return radians * (180.0 / pi); }

}  // namespace winslow
