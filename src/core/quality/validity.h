#pragma once

#include "core/mesh/coordinates.h"
#include "core/mesh/topology.h"
#include "core/types.h"

namespace winslow {

/// The validity of a mesh, which every outer iteration checks.
struct Validity {
  Index inverted = 0;   ///< elements
  double min_sine = 0;  ///< smallest normalized Jacobian; of a volume mesh smallest scaled Jacobian
                        ///< of the elements that have an interior node
};

/// Smallest root t > 0 of d0 + d1 t + d2 t^2, with d0 > 0; infinite if there is none.
double first_positive_root(double d0, double d1, double d2);

/// The same for d0 + d1 t + d2 t^2 + d3 t^3, rounded down: the cubic is positive from 0 to the
/// result.
double first_positive_root(double d0, double d1, double d2, double d3);

/// The largest step along the straight line from one set of coordinates to another that keeps a
/// mesh valid: the largest t <= most such that from + s (to - from) has no inverted corner for any
/// s in [0, t). It is 0 if `from` is not valid. The result is exact, since the area of each corner
/// triangle is a quadratic in s, and the volume of each corner tetrahedron a cubic. Inside
/// hexahedra and prisms the Jacobian may become negative at a smaller step, see check_validity().
/// threads: 0 for all cores; the result does not depend on it. Throws UsageError for a surface
/// mesh.
double largest_valid_step(const Topology& topology, const Coordinates& from, const Coordinates& to,
                          double most = std::numeric_limits<double>::infinity(), int threads = 0);

/// The same for a surface mesh. The area of a corner is measured along its area vector in `from`.
/// normals: the reference normals of the elements (#elements).
double largest_valid_step_on_surface(const Topology& topology, const Coordinates& from,
                                     const Coordinates& to, std::span<const Vec3> normals,
                                     double most = std::numeric_limits<double>::infinity(),
                                     int threads = 0);

}  // namespace winslow
