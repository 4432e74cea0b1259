#pragma once

#include "core/geometry/surface/surface.h"
#include "core/geometry/surface/triangulation.h"

namespace winslow {

/// The plane, cylinder or sphere on which all points of a triangulation lie to within `tolerance`
/// times its extent; null if there is none. A cylinder or sphere takes ten points, and triangles
/// that face away from its axis or centre, or towards it, all of them: fewer points, or the corners
/// of a box, lie on one by chance.
std::unique_ptr<const Surface> recognised_surface(const Triangulation& surface,
                                                  double tolerance = 1e-6);

/// That, or else the SmoothSurface through the points. tangents: see point_normals().
std::unique_ptr<const Surface> surface_through(Triangulation surface,
                                               std::span<const Vec3> tangents);

}  // namespace winslow
