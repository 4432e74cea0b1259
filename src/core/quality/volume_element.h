#pragma once

#include <Eigen/Geometry>
#include <cmath>

#include "core/mesh/coordinates.h"
#include "core/mesh/corner_tetrahedra.h"
#include "core/mesh/element_type.h"
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

/// One element of a volume mesh, as the metrics in space see it. A corner is compared with that of
/// the regular element of its type (regular_corners()): unit edges, equilateral triangles, square
/// faces. Definitions: see Metric.
class VolumeElement {
 public:
  VolumeElement(const Coordinates& x, ElementType type, std::span<const Index> corners)
      : coordinates_(x), x_(x), type_(type), corners_(corners) {}

  bool inverted() const;  ///< the Jacobian is not positive all over it
  double scaled_jacobian() const;
  double radius_ratio() const;      ///< infinite where inverted
  double condition_number() const;  ///< infinite where inverted
  double smallest_solid_angle() const;
  double largest_solid_angle() const;
  double volume() const;

 private:
  double solid_angle(std::size_t corner) const;

  const Coordinates& coordinates_;
  SpacePoints x_;
  ElementType type_;
  std::span<const Index> corners_;
};

/// Whether the Jacobian of a volume element's map from its reference element is positive all over
/// it, its corners included; a Jacobian that is not a number is not.
///
/// - tetrahedron: constant.
/// - pyramid: (1 - zeta)^2 times a bilinear function of the base's two coordinates (D = det(q_xi,
///   q_eta, apex - q) with q the bilinear base has degree one in each), so its corners decide.
/// - prism: linear over the triangle and quadratic along the third direction: three quadratics
///   decide.
/// - hexahedron: of degree two in each of three directions. Its 27 Bernstein coefficients bound it
///   from below, its values at the lattice of corners, mid-points and centres from above; where
///   these disagree the element is divided into eight, up to five times (A. Johnen, J.-F. Remacle,
///   C. Geuzaine, J. Comput. Phys. 233, 2013). What is undecided then counts as not positive: the
///   Jacobian comes within 1e-6 of its largest value of zero, or so.
bool has_positive_jacobian(const SpacePoints& x, ElementType type, std::span<const Index> corners);

}  // namespace winslow
