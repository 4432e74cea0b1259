#pragma once

#include <memory>
#include <span>
#include <vector>

#include "core/geometry/curve.h"
#include "core/geometry/surface/surface.h"
#include "core/geometry/surface/triangulation.h"
#include "core/geometry/surface_features.h"

/// The curves and surfaces through the nodes of a surface that was cut at its features.
namespace winslow {

/// Curves along feature lines (curve_through()).
struct FeatureCurves {
  /// One per line; null for lines of fewer than two nodes, and loops of fewer than four.
  std::vector<std::shared_ptr<const SpaceCurve>> curves;
  /// #nodes: of the curves, where lines run through a node; elsewhere zero.
  std::vector<Vec3> tangents;
};
FeatureCurves curves_along(const SpacePoints& x, const SurfaceFeatures& features);

/// The faces of each region (#regions).
std::vector<std::vector<Index>> faces_of_regions(const SurfaceFeatures& features);

/// The nodes of some faces, ascending.
std::vector<Index> nodes_of_faces(std::span<const SurfaceFace> faces,
                                  std::span<const Index> chosen);

/// Some faces as triangles; quadrilaterals are cut along their shorter diagonal. Points are in the
/// order of `nodes`, those of the faces in ascending order.
Triangulation triangulated(const SpacePoints& x, std::span<const SurfaceFace> faces,
                           std::span<const Index> chosen, std::span<const Index> nodes);

/// surface_through() some faces.
std::shared_ptr<const Surface> surface_over(const SpacePoints& x,
                                            std::span<const SurfaceFace> faces,
                                            std::span<const Index> chosen,
                                            const FeatureCurves& curves);

}  // namespace winslow
