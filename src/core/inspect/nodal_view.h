#pragma once

#include "core/formulation/stencil_operator.h"
#include "core/vcv/virtual_control_volumes.h"

/// What the operator knows at a node of a plane mesh:
///
///     const auto view = winslow::inspect_node(*state.vcvs.plane(), state.mesh.coordinates, node);
///     std::printf("%zu neighbours, kappa %.3f\n", view.neighbours.size(), view.kappa);
namespace winslow {

/// A star of triangles: edges from a node to its neighbours, counter-clockwise; triangle k and
/// angle k lie between edge k and edge k + 1 (cyclic).
struct Star {
  std::vector<Vec2> points;     ///< neighbours relative to the node
  std::vector<double> angles;   ///< radians; the physical star's are signed
  std::vector<double> lengths;  ///< of the edges
  std::vector<double> areas;    ///< of the triangles, signed

  double mean_length() const;
};
/// Angles, lengths and areas from the points.
Star make_star(std::vector<Vec2> points);

/// All that the paper's operator knows at one free node.
struct NodalView {
  Index node = -1;
  std::vector<Index> neighbours;  ///< counter-clockwise, as in Topology::neighbours()
  Vec2 position{0, 0};            ///< of the node, physical
  Star physical;                  ///< units of the mesh; cut at the corners of quadrilaterals
  Star vcv;                       ///< edge 0 on the positive x axis
  bool edited = false;            ///< the VCV is not the paper's (equal angles, unit edges)
  NodalGradient gradient;         ///< columns of the nodal Jacobian, virtual to physical
  /// Singular values of the nodal Jacobian, the larger first, and their ratio kappa (infinite where
  /// the smaller is zero).
  std::array<double, 2> singular_values{0, 0};
  double kappa = 1;
  WinslowCoefficients coefficients;
  std::vector<double> weights;  ///< of the neighbours, not clipped
  double smallest_weight = 0;   ///< over the mean magnitude of the weights
  Vec2 residual{0, 0};          ///< sum_k w_k (r_k - r_0)
  double scaled_residual = 0;   ///< distance to where the node alone would go, over its mean edge
};

/// Throws UsageError, saying why, for a node that has no VCV: one on the boundary, on a marker,
/// that no element uses, or that does not exist.
void require_inspectable(const Topology& topology, Index node);

/// Of a surface mesh the star is laid flat: its angles, each measured in its own triangle, are
/// scaled to 360 degrees together, edge 0 lies on the positive x axis, and the node is at the
/// origin. Throws as require_inspectable() does.
NodalView inspect_node(const VirtualControlVolumes& vcv, const Coordinates& x, Index node);

/// The plane in which what is flat is drawn over a node of a surface mesh.
struct StarPlane {
  Vec3 origin, u, v;  ///< u, v: unit vectors at right angles
  Vec3 at(const Vec2& p) const { return origin + p.x() * u + p.y() * v; }
};
/// The tangent plane of a surface mesh at the node of a view of it, in which the star that was laid
/// flat lies as nearly as can be over the star in space.
StarPlane plane_of_star(const Topology& topology, const Coordinates& x, const NodalView& view);

/// Angle (radians, counter-clockwise) by which a VCV is turned to lie over its physical star: that
/// which brings the directions of its edges nearest to those of the star.
double fitted_turn(const Star& vcv_star, const Star& physical);

/// Singular values of the 2x2 matrix with these columns, the larger first.
std::array<double, 2> singular_values(const NodalGradient& jacobian);

}  // namespace winslow
