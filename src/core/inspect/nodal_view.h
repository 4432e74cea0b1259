#pragma once

#include "core/formulation/stencil_operator.h"
#include "core/vcv/sphere/node_vcv.h"
#include "core/vcv/virtual_control_volumes.h"

/// The operator at a node of a plane mesh:
///
///     const auto view = winslow::inspect_node(*state.vcvs.plane(), state.mesh.coordinates, node);
///     std::printf("%zu neighbours, kappa %.3f\n", view.neighbours.size(), view.kappa);
namespace winslow {

/// The edges from a node to its neighbours.
template <int D>
struct StarEdges {
  std::vector<Vec<D>> points;   ///< neighbours relative to the node
  std::vector<double> lengths;  ///< of the edges

  double mean_length() const {
    const double sum = std::accumulate(lengths.begin(), lengths.end(), 0.0);
    return lengths.empty() ? 0 : sum / static_cast<double>(lengths.size());
  }
};

/// The row of the operator at a node.
template <int D>
struct OperatorView {
  Index node = -1;
  std::vector<Index> neighbours;     ///< as in Topology::neighbours()
  Vec<D> position = Vec<D>::Zero();  ///< of the node, physical
  double kappa = 1;                  ///< largest over smallest singular value of the nodal
                                     ///< Jacobian; infinite if the smallest is zero
  std::vector<double> weights;       ///< of the neighbours, not clipped
  double smallest_weight = 0;        ///< over the mean magnitude of the weights
  Vec<D> residual = Vec<D>::Zero();  ///< sum_k w_k (r_k - r_0)
  double scaled_residual = 0;        ///< length of a step of this node alone, over its mean edge

  void set(const NodalRowOf<D>& row) {
    smallest_weight = row.smallest_weight(weights);
    residual = row.residual;
    scaled_residual = row.scaled();
  }
};

/// A star of triangles: edges from a node to its neighbours, counter-clockwise; triangle k and
/// angle k lie between edge k and edge k + 1 (cyclic).
struct Star : StarEdges<2> {
  std::vector<double> angles;  ///< radians; signed in the physical star
  std::vector<double> areas;   ///< of the triangles, signed
};
/// Computes angles, lengths and areas from the points.
Star make_star(std::vector<Vec2> points);

/// The paper's operator at one free node of a plane or surface mesh.
struct NodalView : OperatorView<2> {
  Star physical;           ///< units of the mesh; quadrilaterals are cut to corner triangles
  Star vcv;                ///< edge 0 on the positive x axis
  bool edited = false;     ///< the VCV differs from the paper's (equal angles, unit edges)
  NodalGradient gradient;  ///< columns of the nodal Jacobian, virtual to physical
  std::array<double, 2> singular_values{0, 0};  ///< of the nodal Jacobian, the larger first
  WinslowCoefficients coefficients;
};

/// Throws UsageError with the reason for a node without a VCV: it lies on the boundary or on a
/// marker, no element uses it, or it does not exist.
void require_inspectable(const Topology& topology, Index node);

/// Evaluates the operator at a node. The star of a node of a surface mesh is laid flat: its angles,
/// each measured in its triangle, are scaled so that their sum is 360 degrees, edge 0 lies on the
/// positive x axis, and the node is at the origin. Throws as require_inspectable() does.
NodalView inspect_node(const VirtualControlVolumes& vcv, const Coordinates& x, Index node);

/// The plane in space in which a flat star is drawn.
struct StarPlane {
  Vec3 origin, u, v;  ///< u, v: unit vectors at right angles
  Vec3 point(const Vec2& p) const { return origin + p.x() * u + p.y() * v; }
};
/// The tangent plane of a surface mesh at the node of a view. It is turned so that the flat star of
/// the view fits the star in space best, see fitted_turn().
StarPlane plane_of_star(const Topology& topology, const Coordinates& x, const NodalView& view);

/// Angle (radians, counter-clockwise) of the rotation of a VCV that brings the directions of its
/// edges nearest to those of the physical star, in the sum of squares.
double fitted_turn(const Star& vcv_star, const Star& physical);

/// Singular values of a nodal Jacobian (2x2, given by its columns), the larger first.
std::array<double, 2> singular_values(const NodalGradient& jacobian);

/// A star of tetrahedra: edges from a node to its neighbours, and the triangles of its link.
struct SphereStar : StarEdges<3> {
  std::vector<double> solid_angles;  ///< of the link's triangles, steradians, signed
  std::vector<double> volumes;       ///< of the tetrahedra over them, signed
};
/// Computes lengths, angles and volumes from the points.
SphereStar make_sphere_star(const SphereLink& link, std::vector<Vec3> points);

/// The paper's operator at one free node of a volume mesh. Edges have the numbers of
/// Topology::neighbours(), triangles those of the link.
struct VolumeNodalView : OperatorView<3> {
  SphereLink link;
  SphereStar physical;          ///< units of the mesh
  SphereStar vcv;               ///< rotated onto the physical star, see fitted_rotation()
  Eigen::Matrix3d turned_by;    ///< from the directions of the stencil to those of `vcv`
  std::vector<double> targets;  ///< target solid angles of the VCV
  double largest_error = 0;     ///< of |Omega / Omega* - 1|
  bool edited = false;          ///< the VCV was given by hand
  /// Columns r_x, r_y, r_z of the nodal Jacobian, from `vcv` to the mesh.
  Eigen::Matrix3d gradient;
  /// gradient = u diag(singular_values) v^T, the largest first. The image of the unit sphere is an
  /// ellipsoid; its half axes are the columns of u times the singular values.
  Vec3 singular_values{0, 0, 0};
  Eigen::Matrix3d u;
  Eigen::Matrix3d tensor;  ///< winslow_tensor()
};

/// Evaluates the operator over a VCV of a node of this mesh at the coordinates x.
VolumeNodalView inspect_node(const Topology& topology, const Coordinates& x, const NodeVcv& vcv);

/// The rotation (of determinant 1) that brings directions nearest to others, in the sum of squares:
/// W. Kabsch, "A solution for the best rotation to relate two sets of vectors", Acta Cryst. A 32,
/// 1976. The weights of the operator do not depend on a rotation of the VCV.
Eigen::Matrix3d fitted_rotation(std::span<const Vec3> from, std::span<const Vec3> to);

}  // namespace winslow
