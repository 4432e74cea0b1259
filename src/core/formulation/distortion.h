#pragma once

#include "core/formulation/cell_targets.h"
#include "core/formulation/simplex_kernel.h"
#include "core/formulation/target_metric.h"
#include "core/formulation/variational_form.h"

/// Distortion of one triangle against one target, and the projection of its Hessian. For values,
/// gradients, exact Hessians and the equations see simplex_kernel.h.
namespace winslow::distortion {

/// Two edges at the triangle's first corner and the determinant.
struct Corner2 {
  double ux, uy, vx, vy, d;

  Corner2(const double* a, const double* b, const double* c)
      : ux(b[0] - a[0]), uy(b[1] - a[1]), vx(c[0] - a[0]), vy(c[1] - a[1]), d(ux * vy - uy * vx) {}

  explicit Corner2(const std::array<Vec2, 3>& p) : Corner2(p[0].data(), p[1].data(), p[2].data()) {}

  double distortion(const ShapeTerm& c) const {
    const double wx = vx - ux, wy = vy - uy;
    return 0.5 *
           (c.ab * (ux * ux + uy * uy) + c.ac * (vx * vx + vy * vy) + c.bc * (wx * wx + wy * wy)) /
           d;
  }
};

/// Hessian of weight * psi(f), projected to positive semidefinite in closed form. inverse_limit: of
/// a guard; 0: of another term. Adds the blocks (2x2, row-major) of a's row at b, a's at c and b's
/// at c to blocks[0..11]; the others are their transposes, and those of a row sum to zero.
///
/// psi(f) depends on the singular values s1 >= s2 of J alone, so the eigenvectors of its Hessian
/// over J are known (B. Smith, F. de Goes, T. Kim, "Analytic Eigensystems for Isotropic Distortion
/// Energies", ACM TOG 38(1), 2019): a twist (eigenvalue (psi_1 + psi_2) / (s1 + s2), never positive
/// here), a flip ((psi_1 - psi_2) / (s1 - s2), always positive) and two scalings, of which
/// exactly one is positive because psi does not change with size.
void add_projected_blocks(const Corner2& q, const ShapeTerm& term, const PenaltyFunction& psi,
                          double inverse_limit, double* blocks);
/// The same for all terms of a cell; replaces the blocks in its sum (TriangleSum).
void project_blocks(const Corner2& q, const CellTargets<2>& targets, std::size_t cell,
                    const PenaltyFunction& psi, double* sum);

/// Distortion of one tetrahedron against one target. For gradients, Hessians and the equations see
/// simplex_kernel.h.

/// The three edges at the tetrahedron's first node, and the determinant.
struct Corner3 {
  Edges3 edges;
  double d;

  explicit Corner3(const std::array<Vec3, 4>& p);
  /// f; not positive if the tetrahedron is inverted.
  double distortion(const VolumeTerm& term) const;
};

template <int D>
using Corner = std::conditional_t<D == 2, Corner2, Corner3>;

}  // namespace winslow::distortion
