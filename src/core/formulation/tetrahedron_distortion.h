#pragma once

#include <array>

#include "core/formulation/penalty_function.h"
#include "core/formulation/volume_metric.h"

/// Distortion of one tetrahedron against one target, and the projection of its Hessian. Values,
/// gradients and exact Hessians: tetrahedron_kernel.h, where the equations are.
namespace winslow::distortion {

/// The three edges at the tetrahedron's first node, and the determinant.
struct Corner3 {
  Edges3 edges;
  double d;

  explicit Corner3(const std::array<Vec3, 4>& p);
  /// f; not positive where the tetrahedron is inverted.
  double distortion(const VolumeTerm& term) const;
};

/// Hessian of weight * psi(f), projected to positive semidefinite. Adds the 3x3 blocks (row-major)
/// of the earlier node's row at the later one, pairs of nodes in lexicographic order, to
/// blocks[0..53]; the others are their transposes, and those of a row sum to zero.
///
/// psi(f) depends on the singular values of J alone, so but for three all eigenvectors of its
/// Hessian over J are known (B. Smith, F. de Goes, T. Kim, "Analytic Eigensystems for Isotropic
/// Distortion Energies", ACM TOG 38(1), 2019): three twists, three flips (always positive here),
/// and three scalings, those of the 3x3 Hessian over the singular values.
void add_projected_blocks(const Corner3& q, const VolumeTerm& term, const PenaltyFunction& psi,
                          double* blocks);

}  // namespace winslow::distortion
