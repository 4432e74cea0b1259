#pragma once

#include <Eigen/Geometry>
#include <cmath>

#include "core/types.h"

namespace winslow {

/// Numerator and denominator of tan(Omega / 2), Omega the solid angle of the triangle a b c of unit
/// vectors (A. van Oosterom, J. Strackee, "The solid angle of a plane triangle", IEEE Trans.
/// Biomed. Eng. 30(2), 1983): N = a . (b x c), D = 1 + a . b + b . c + c . a.
struct SolidAngleTangent {
  double n, d;
};

inline SolidAngleTangent solid_angle_tangent(const Vec3& a, const Vec3& b, const Vec3& c) {
  // By differences: a small triangle loses no digits.
  return {a.dot((b - a).cross(c - a)), 1 + a.dot(b) + b.dot(c) + c.dot(a)};
}

/// Solid angle, in steradians, of the spherical triangle a b c of unit vectors: in (-2 pi, 2 pi],
/// positive where it is counter-clockwise seen from outside. A triangle beyond a half of the sphere
/// counts as its complement, seen from inside; with two opposite corners it has no angle of its
/// own.
inline double solid_angle(const Vec3& a, const Vec3& b, const Vec3& c) {
  const SolidAngleTangent t = solid_angle_tangent(a, b, c);
  return 2 * std::atan2(t.n, t.d);
}

/// A solid angle and its derivatives by the corners. Of each derivative only the part in the
/// tangent plane of its corner means anything.
struct SolidAngleGradient {
  double angle;
  Vec3 by_a, by_b, by_c;
};

/// See solid_angle(). With two opposite corners the derivatives are zero.
inline SolidAngleGradient solid_angle_gradient(const Vec3& a, const Vec3& b, const Vec3& c) {
  const auto [n, d] = solid_angle_tangent(a, b, c);
  const double square = n * n + d * d;
  const double scale = square > 0 ? 2 / square : 0;
  const double dn = scale * d, dd = -scale * n;  // of Omega, by N and by D
  return {2 * std::atan2(n, d), dn * b.cross(c) + dd * (b + c), dn * c.cross(a) + dd * (c + a),
          dn * a.cross(b) + dd * (a + b)};
}

}  // namespace winslow
