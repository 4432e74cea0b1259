#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/formulation/target_shapes.h"
#include "core/types.h"

namespace winslow {

/// Metric of a target triangle over its two edges m1, m2 from the corner: symmetric, determinant 1.
/// It is the inverse of their Gram matrix, scaled. Two triangles are similar if their metrics are
/// the same; the distance between metrics is twice the logarithm of how much longer than wide one
/// triangle is in the other's shape.
struct TargetMetric {
  double a11 = 0, a12 = 0, a22 = 0;

  static TargetMetric of(const Vec2& m1, const Vec2& m2) {
    const double det = m1.x() * m2.y() - m1.y() * m2.x();
    return {m2.squaredNorm() / det, -m1.dot(m2) / det, m1.squaredNorm() / det};
  }
  /// Of edges in space, as they lie in their own plane.
  static TargetMetric in_space(const Vec3& m1, const Vec3& m2) {
    const double det = m1.cross(m2).norm();
    return {m2.squaredNorm() / det, -m1.dot(m2) / det, m1.squaredNorm() / det};
  }
  static TargetMetric of_angle(double angle) {
    return of(Vec2(1, 0), Vec2(std::cos(angle), std::sin(angle)));
  }
  static TargetMetric of(const ShapeTerm& term) {
    return {term.ab + term.bc, -term.bc, term.ac + term.bc};
  }
  TargetMetric& add(double share, const TargetMetric& other) {
    a11 += share * other.a11;
    a12 += share * other.a12;
    a22 += share * other.a22;
    return *this;
  }
  /// A sum of such metrics, scaled back to determinant 1, lies on the geodesic between them.
  TargetMetric normalized() const {
    const double scale = 1 / std::sqrt(a11 * a22 - a12 * a12);
    return {a11 * scale, a12 * scale, a22 * scale};
  }
  ShapeTerm term(double weight) const { return {a11 + a12, a22 + a12, -a12, weight}; }
};

/// Logarithm of s1 / s2, the singular values of the linear map between triangles with these
/// metrics: 0 if they are similar.
inline double stretch_between(const TargetMetric& a, const TargetMetric& b) {
  return std::acosh(std::max(1.0, 0.5 * (a.a22 * b.a11 + a.a11 * b.a22) - a.a12 * b.a12));
}

/// The metric at `share` of the way along the geodesic from a (0) to b (1).
inline TargetMetric between(const TargetMetric& a, const TargetMetric& b, double share) {
  const double way = stretch_between(a, b);
  TargetMetric metric;
  constexpr double short_way = 1e-4;  // below it the sines are their arguments, to round-off
  if (way < short_way) return metric.add(1 - share, a).add(share, b).normalized();
  metric.add(std::sinh((1 - share) * way) / std::sinh(way), a);
  metric.add(std::sinh(share * way) / std::sinh(way), b);
  return metric;
}

}  // namespace winslow
