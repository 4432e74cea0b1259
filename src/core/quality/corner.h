#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <limits>

#include "core/mesh/coordinates.h"

namespace winslow {

/// Whether an element of a surface mesh shows the other side than its reference normal says: if it
/// faces away by more than 120 degrees. Where a surface is finely meshed that is told from 0 and
/// 180 degrees; over a sharp tip a sound element may well stand across the mean of the normals at
/// its nodes. area: at right angles to the element.
inline bool is_turned_over(const Vec3& area, const Vec3& normal) {
  constexpr double farthest = -0.5;  // cosine
  return area.dot(normal) < farthest * area.norm();
}

/// The triangle of an element's corner and its two neighbours within the element.
struct Corner {
  double l1 = 0, l2 = 0, l3 = 0;  ///< edges at the corner (next, previous), and the one across
  double area2 = 0;               ///< twice the signed area
  double dot = 0;                 ///< scalar product of the two edges at the corner

  Corner() = default;
  Corner(const Vec2& at, const Vec2& next, const Vec2& previous) {
    const Vec2 a = next - at;
    const Vec2 b = previous - at;
    l1 = a.norm();
    l2 = b.norm();
    l3 = (next - previous).norm();
    area2 = a.x() * b.y() - a.y() * b.x();
    dot = a.dot(b);
  }

  /// Of an element of a surface mesh, in its own plane. normal: the side that the element should
  /// show; the area is negative if the corner shows the other.
  Corner(const Vec3& at, const Vec3& next, const Vec3& previous, const Vec3& normal) {
    const Vec3 a = next - at;
    const Vec3 b = previous - at;
    l1 = a.norm();
    l2 = b.norm();
    l3 = (next - previous).norm();
    const Vec3 area = a.cross(b);
    area2 = is_turned_over(area, normal) ? -area.norm() : area.norm();
    dot = a.dot(b);
  }

  bool inverted() const { return !(area2 > 0); }
  double sine() const { return l1 > 0 && l2 > 0 ? area2 / (l1 * l2) : 0; }
  /// From the next edge counter-clockwise to the previous one, degrees in (-180, 180]: negative
  /// where the corner is inverted.
  double angle() const { return degrees(std::atan2(area2, dot)); }
  /// R/(2r): 1 for the equilateral triangle.
  double radius_ratio() const {
    return inverted() ? std::numeric_limits<double>::infinity()
                      : l1 * l2 * l3 * (l1 + l2 + l3) / (4 * area2 * area2);
  }
  /// Condition weighted to the equilateral triangle.
  double triangle_condition() const {
    return inverted() ? std::numeric_limits<double>::infinity()
                      : (l1 * l1 + l2 * l2 + l3 * l3) / (2 * std::sqrt(3.0) * area2);
  }
  /// Condition relative to a square's corner.
  double square_condition() const {
    return inverted() ? std::numeric_limits<double>::infinity() : (l1 * l1 + l2 * l2) / (2 * area2);
  }
};

inline Corner corner_of(const Coordinates& x, std::span<const Index> element, std::size_t k) {
  const std::size_t n = element.size();
  return {x.xy(element[k]), x.xy(element[(k + 1) % n]), x.xy(element[(k + n - 1) % n])};
}

/// The same of a surface mesh.
inline Corner corner_of(const Points<3>& x, std::span<const Index> element, std::size_t k,
                        const Vec3& normal) {
  const std::size_t n = element.size();
  return {x[element[k]], x[element[(k + 1) % n]], x[element[(k + n - 1) % n]], normal};
}

}  // namespace winslow
