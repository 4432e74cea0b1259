#pragma once

#include <memory>

#include "core/geometry/surface/triangulation.h"
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
  Derivatives derivatives(double u, double v) const;

 private:
  /// Of the 15 Bezier points of a quartic triangle the 12 of its border, and six in place of the
  /// three inner ones, each of which is blended from two.
  std::array<Vec3, 18> points_;
  bool flat_ = false;
};

/// The surface through the points of a triangulation that has one normal everywhere: a
/// SurfacePatch over each triangle. Through its points exactly.
class SmoothSurface final : public Surface {
 public:
  /// normals: at the points, of length 1 (#points).
  SmoothSurface(Triangulation surface, std::span<const Vec3> normals);

  /// At the border the nearest place on it.
  SurfacePoint nearest(const Vec3& point) const override;
  std::string description() const override;

  const Triangulation& triangulation() const { return surface_; }
  /// The point over a place in a triangle, by its barycentric coordinates.
  SurfacePoint over(Index triangle, const Vec3& place) const;
  /// The triangle and the place in it over which the point of the surface lies that is nearest.
  TrianglePlace nearest_place(const Vec3& point) const;

 private:
  Triangulation surface_;
  std::vector<std::array<Index, 3>> neighbours_;
  std::vector<SurfacePatch> patches_;
  TriangleTree tree_;
};

}  // namespace winslow
