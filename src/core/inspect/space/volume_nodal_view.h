#pragma once

#include "core/formulation/stencil_operator.h"
#include "core/vcv/sphere/node_vcv.h"

namespace winslow {

/// A star of tetrahedra: edges from a node to its neighbours, and the triangles of its link.
struct SphereStar {
  std::vector<Vec3> points;          ///< neighbours relative to the node
  std::vector<double> lengths;       ///< of the edges
  std::vector<double> solid_angles;  ///< of the link's triangles, steradians, signed
  std::vector<double> volumes;       ///< of the tetrahedra over them, signed

  double mean_length() const;
};
/// Lengths, angles and volumes from the points.
SphereStar make_sphere_star(const SphereLink& link, std::vector<Vec3> points);

/// All that the paper's operator knows at one free node of a volume mesh. Edges are numbered as
/// Topology::neighbours(), triangles as the link's.
struct VolumeNodalView {
  Index node = -1;
  std::vector<Index> neighbours;
  Vec3 position{0, 0, 0};  ///< of the node, physical
  SphereLink link;
  SphereStar physical;          ///< units of the mesh
  SphereStar vcv;               ///< turned to lie over the physical star, see fitted_rotation()
  Eigen::Matrix3d turned_by;    ///< from the stencil's directions to those of `vcv`
  std::vector<double> targets;  ///< solid angles that the VCV is to have
  double largest_error = 0;     ///< of |Omega / Omega* - 1|
  bool edited = false;          ///< the VCV was given by hand
  /// Columns r_x, r_y, r_z of the nodal Jacobian, from the VCV as it is turned here to the mesh.
  Eigen::Matrix3d gradient;
  /// gradient = u diag(singular_values) v^T, the largest first: the unit sphere's image is the
  /// ellipsoid with the columns of u times the singular values for half axes.
  Vec3 singular_values{0, 0, 0};
  Eigen::Matrix3d u;
  double kappa = 1;        ///< largest over smallest singular value; infinite where that is zero
  Eigen::Matrix3d tensor;  ///< winslow_tensor()
  std::vector<double> weights;  ///< of the neighbours, not clipped
  double smallest_weight = 0;   ///< over the mean magnitude of the weights
  Vec3 residual{0, 0, 0};       ///< sum_k w_k (r_k - r_0)
  double scaled_residual = 0;   ///< distance to where the node alone would go, over its mean edge
};

/// What the operator over this VCV, of a node of this mesh, comes to at the coordinates x.
VolumeNodalView inspect_node(const Topology& topology, const Coordinates& x, const NodeVcv& vcv);

/// The rotation (of determinant 1) that brings directions nearest to others, in the sum of squares:
/// W. Kabsch, "A solution for the best rotation to relate two sets of vectors", Acta Cryst. A 32,
/// 1976. Weights, which do not see how a VCV is turned, are the same afterwards.
Eigen::Matrix3d fitted_rotation(std::span<const Vec3> from, std::span<const Vec3> to);

}  // namespace winslow
