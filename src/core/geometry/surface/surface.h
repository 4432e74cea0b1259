#pragma once

#include <memory>

#include "core/geometry/surface/triangulation.h"
#include "core/types.h"

namespace winslow {

/// A point of a surface.
struct SurfacePoint {
  Vec3 point{0, 0, 0};
  Vec3 normal{0, 0, 1};  ///< unit vector
  /// The second fundamental form, in 1/length: a geodesic with the velocity v has the acceleration
  /// (v . form v) normal. It is symmetric and zero along the normal.
  Eigen::Matrix3d form = Eigen::Matrix3d::Zero();
};

/// A surface that boundary nodes slide on.
class Surface {
 public:
  virtual ~Surface() = default;
  /// The point of the surface nearest to a point. Planes, cylinders and spheres extend beyond their
  /// faces.
  virtual SurfacePoint nearest(const Vec3& point) const = 0;
  /// Whether the surface extends beyond its faces.
  virtual bool goes_on() const { return false; }
  /// "plane", "cylinder of radius 2", "sphere of radius 1", "smooth surface through 200 nodes": for
  /// reports.
  virtual std::string description() const = 0;
};

/// The inner Bezier points of the cubic from a to b that is perpendicular to the normals at both
/// ends (D. J. Walton, D. S. Meek, "A triangular G1 patch from boundary curves", CAD 28(2), 1996).
/// From b to a it is the same curve. Unit normals.
std::array<Vec3, 2> edge_between(const Vec3& a, const Vec3& b, const Vec3& normal_a,
                                 const Vec3& normal_b);

/// A curved triangle of degree four with given vertices and normals. Triangles with a common edge
/// and the same normals at its ends have the same cubic and the same tangent planes along it (the
/// same paper). So their surface is smooth.
class SurfacePatch {
 public:
  /// The flat triangle.
  explicit SurfacePatch(const std::array<Vec3, 3>& vertices);
  /// Unit normals on one side of the triangle. The patch is flat if the angle between one of them
  /// and the normal of the triangle is more than 60 degrees.
  SurfacePatch(const std::array<Vec3, 3>& vertices, const std::array<Vec3, 3>& normals);

  /// A point and its derivatives by u and v, the barycentric coordinates of the first and second
  /// vertex, the third's being 1 - u - v.
  struct Derivatives {
    Vec3 r, u, v, uu, uv, vv;
  };
  Derivatives derivatives(double u, double v) const;

 private:
  /// The 12 Bezier points of the border of a quartic triangle, and six in place of its three inner
  /// points, each of which is blended from two.
  std::array<Vec3, 18> points_;
  bool flat_ = false;
};

/// The smooth surface through the points of a triangulation: a SurfacePatch over each triangle.
class SmoothSurface final : public Surface {
 public:
  /// normals: unit normals at the points (#points).
  SmoothSurface(Triangulation surface, std::span<const Vec3> normals);

  /// For points beyond the border, returns the nearest point of the border.
  SurfacePoint nearest(const Vec3& point) const override;
  std::string description() const override;

  const Triangulation& triangulation() const { return surface_; }
  /// The point of the surface over a place in a triangle, by its barycentric coordinates.
  SurfacePoint over(Index triangle, const Vec3& place) const;
  /// The place of the triangulation under the nearest point of the surface.
  TrianglePlace nearest_place(const Vec3& point) const;

 private:
  Triangulation surface_;
  std::vector<std::array<Index, 3>> neighbours_;
  std::vector<SurfacePatch> patches_;
  TriangleTree tree_;
};

/// The plane, cylinder or sphere on which all points of a triangulation lie within `tolerance`
/// times its extent; null if there is none. A cylinder or sphere must have at least ten points, and
/// its triangles must all face outwards or all inwards: fewer points, or the corners of a box, may
/// lie on one by chance.
std::unique_ptr<const Surface> recognised_surface(const Triangulation& surface,
                                                  double tolerance = 1e-6);

/// The recognised_surface() or else the SmoothSurface through the points. tangents: see
/// point_normals().
std::unique_ptr<const Surface> surface_through(Triangulation surface,
                                               std::span<const Vec3> tangents);

}  // namespace winslow
