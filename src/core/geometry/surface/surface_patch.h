#pragma once

#include <array>
#include <span>

#include "core/types.h"

namespace winslow {

/// Triangles with vertices and normals that are given, all of them faces of one smooth surface.

/// The inner Bezier points of the cubic edge from a to b that leaves both at right angles to their
/// normals (D. J. Walton, D. S. Meek, "A triangular G1 patch from boundary curves", CAD 28(2),
/// 1996). The same curve, the other way round, for b to a. Normals of length 1.
std::array<Vec3, 2> edge_between(const Vec3& a, const Vec3& b, const Vec3& normal_a,
                                 const Vec3& normal_b);

/// A curved triangle of degree four. Triangles that share an edge, with its vertices and normals,
/// share the cubic and all tangent planes along it (the same paper), so that the surface of all has
/// one normal everywhere.
class SurfacePatch {
 public:
  /// The flat triangle.
  explicit SurfacePatch(const std::array<Vec3, 3>& vertices);
  /// Normals of length 1, on one side of the triangle. Flat where no smooth patch can be made of
  /// them: one of the normals is farther than 60 degrees from the triangle's.
  SurfacePatch(const std::array<Vec3, 3>& vertices, const std::array<Vec3, 3>& normals);

  /// A point and its derivatives by u and v, the barycentric coordinates of the first and second
  /// vertex, the third's being 1 - u - v.
  struct Derivatives {
    Vec3 r, u, v, uu, uv, vv;
  };
  Derivatives at(double u, double v) const;

 private:
  /// Of the 15 Bezier points of a quartic triangle the 12 of its border, and six in place of the
  /// three inner ones, each of which is blended from two.
  std::array<Vec3, 18> points_;
  bool flat_ = false;
};

}  // namespace winslow
