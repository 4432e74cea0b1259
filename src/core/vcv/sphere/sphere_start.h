#pragma once

#include <array>
#include <span>
#include <vector>

#include "core/vcv/sphere/sphere_link.h"
#include "core/vcv/sphere/upper_cholesky.h"

namespace winslow {

/// Places the vertices of a link on the unit sphere so that no triangle is inverted, by its
/// connectivity alone:
///
/// 1. Tutte's embedding in the plane: the corners of one triangle are held, every other vertex is a
///    mean of its neighbours, weighted by the stress of the edges (W. T. Tutte, "How to draw a
///    graph", 1963; one without crossings, since the graph is 3-connected);
/// 2. its lift to a convex polyhedron (Maxwell, Cremona): the slopes of neighbouring triangles
///    differ by their edge turned by a right angle, times its stress;
/// 3. an affine map and a centre inside for which the directions to the vertices are spread evenly:
///    their mean is zero and their second moments are alike (D. E. Tyler, "A distribution-free
///    M-estimator of multivariate scatter", Ann. Stat. 15, 1987). The centre is a mean with
///    positive weights, so every iterate is as valid as the last;
/// 4. projection from the centre. Faces of a convex body seen from inside do not overlap.
///
/// One object for many links keeps its memory.
class SphereStart {
 public:
  /// directions: #vertices. Throws NumericError where round-off has the last word: triangles nested
  /// so deeply that Tutte's embedding cannot show the innermost ones.
  void place(const SphereLink& link, std::span<Vec3> directions);

 private:
  void embed(const SphereLink& link, const SphereLink::Triangle& outer);
  void lift(const SphereLink& link, Index outer);
  void spread(std::span<Vec3> directions);

  UpperCholesky laplacian_;
  std::vector<Index> row_;     // by vertex, -1 for those of the outer triangle
  std::vector<double> x_, y_;  // by row
  std::vector<Vec3> points_;   // by vertex
  std::vector<Vec3> planes_;   // by triangle: slopes and height above the origin
  std::vector<Index> todo_;
  std::vector<char> reached_;
};

/// All solid angles positive and the sphere covered once.
bool covers_sphere(const SphereLink& link, std::span<const Vec3> directions);

}  // namespace winslow
