#pragma once

#include <limits>

#include "core/mesh/coordinates.h"
#include "core/mesh/topology.h"
#include "core/types.h"

namespace winslow {

/// What every outer iteration needs to know of a mesh.
struct Validity {
  Index inverted = 0;   ///< elements
  double min_sine = 0;  ///< smallest normalized Jacobian; in space the scaled one, of the elements
                        ///< of which some node is inside
};

/// Smallest t > 0 at which d0 + d1 t + d2 t^2 vanishes, d0 > 0; infinite if it never does.
double first_positive_root(double d0, double d1, double d2);

/// The same of d0 + d1 t + d2 t^2 + d3 t^3, from below: the cubic is positive up to what is
/// returned.
double first_positive_root(double d0, double d1, double d2, double d3);

/// How far a valid mesh can go on the straight line from one set of coordinates to another: the
/// largest t such that from + s (to - from) has no inverted corner for any s in [0, t). Exact: the
/// area of each corner triangle is a quadratic in s, the volume of each corner tetrahedron a cubic.
/// (Hexahedra and prisms may lose the sign of their Jacobian inside before that: check_validity()
/// tells.) `most` if that is larger; 0 if `from` is not valid. threads: 0 for all cores; the result
/// does not depend on it. Throws UsageError for a surface mesh.
double largest_valid_step(const Topology& topology, const Coordinates& from, const Coordinates& to,
                          double most = std::numeric_limits<double>::infinity(), int threads = 0);

/// The same of a surface mesh: corners whose area stays positive, seen as they were at first.
/// normals: the reference normals of the elements (#elements).
double largest_valid_step_on_surface(const Topology& topology, const Coordinates& from,
                                     const Coordinates& to, std::span<const Vec3> normals,
                                     double most = std::numeric_limits<double>::infinity(),
                                     int threads = 0);

}  // namespace winslow
