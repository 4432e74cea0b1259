#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <optional>

#include "core/mesh/coordinates.h"
#include "core/mesh/element_type.h"
#include "core/types.h"

namespace winslow {

/// The three edges of a volume element at one of its corners.
struct VolumeCorner {
  Eigen::Matrix3d edges;  ///< columns
  double determinant;     ///< of the edges: six times the volume of the corner's tetrahedron

  VolumeCorner(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
    edges << a - p, b - p, c - p;
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

/// The metrics of one volume element; for definitions see Metric. Corners are compared with those
/// of the regular element (regular_corners()): unit edges, equilateral triangles, square faces.
class VolumeElement {
 public:
  /// shape: must outlive this.
  VolumeElement(const Coordinates& x, const ElementShape& shape, std::span<const Index> corners)
      : coordinates_(x), x_(x), shape_(shape), corners_(corners) {}

  bool inverted() const;  ///< the Jacobian is not positive everywhere
  double scaled_jacobian() const;
  double radius_ratio() const;      ///< infinite where inverted
  double condition_number() const;  ///< infinite where inverted
  double smallest_solid_angle() const { return solid_angles().smallest; }
  double largest_solid_angle() const { return solid_angles().largest; }
  double volume() const;

 private:
  struct SolidAngles {
    double smallest, largest;
  };
  double solid_angle(std::size_t corner) const;
  double solid_angle_of_faces(std::size_t corner) const;
  /// Found once, since both take long.
  const SolidAngles& solid_angles() const;

  const Coordinates& coordinates_;
  SpacePoints x_;
  const ElementShape& shape_;
  std::span<const Index> corners_;
  mutable std::optional<SolidAngles> solid_angles_;
};

/// Whether the Jacobian of the map from the reference element to a volume element is positive
/// everywhere, corners included. NaN is not positive.
///
/// - tetrahedron: constant.
/// - pyramid: (1 - zeta)^2 times a bilinear function of the base's two coordinates (D = det(q_xi,
///   q_eta, apex - q) with q the bilinear base has degree one in each), so its corners decide.
/// - prism: linear over the triangle and quadratic along the third direction, so the quadratics
///   along the three vertical edges decide.
/// - hexahedron: of degree two in each of three directions. The smallest of its 27 Bernstein
///   coefficients is a lower bound; the values at the corners, midpoints and centres are upper
///   bounds of its minimum. If these do not decide, the element is divided into eight, up to five
///   times (A. Johnen, J.-F. Remacle, C. Geuzaine, J. Comput. Phys. 233, 2013). If it is still
///   undecided it counts as not positive: the minimum is then within about 1e-6 of the largest
///   value from zero.
/// - polyhedron: its corner tetrahedra and face tetrahedra are positive (PolyhedronShape), and so
///   are the pyramids from its centroid over its faces, as OpenFOAM asks (checkMesh, "face
///   pyramids").
bool has_positive_jacobian(const SpacePoints& x, const ElementShape& shape,
                           std::span<const Index> corners);

}  // namespace winslow
