#pragma once

#include <memory>
#include <span>
#include <vector>

#include "core/geometry/surface/surface.h"
#include "core/geometry/surface/surface_patch.h"
#include "core/geometry/surface/triangle_tree.h"
#include "core/geometry/surface/triangulation.h"

namespace winslow {

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
