#pragma once

#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "core/formulation/formulation.h"
#include "core/formulation/row_blocks.h"
#include "core/formulation/target_shapes.h"
#include "core/linear/sparse_system.h"

namespace winslow {

/// Which second derivative of the energy a Newton system is made of.
enum class Curvature {
  exact,     ///< the Hessian: quadratic convergence near a solution
  projected  ///< each triangle's Hessian projected to positive semidefinite: always downhill
};

/// Replaces the barrier for meshes with inverted elements: the determinant D (twice the area) of a
/// triangle by chi = (D + sqrt(e^2 + D^2)) / 2, e = epsilon * size[triangle], which is positive for
/// every D (V. A. Garanzha et al., "Foldover-free maps in 50 lines of code", ACM TOG 40(4), 2021).
struct Regularisation {
  double epsilon = 1;
  std::vector<double> size;  ///< #triangles of the TargetShapes: a determinant each is measured in
};

/// Shape of psi.
struct PenaltyOptions {
  double exponent = 8;  ///< p >= 1
  double knee = 1.78;   ///< distortion f from which the power counts, > 1; 0: psi(f) = f^p

  bool operator==(const PenaltyOptions&) const = default;
};

/// What an assembly of the Newton system finds out besides.
struct Linearisation {
  ResidualNorms norms;
  double energy;
};

/// Winslow smoothing as a minimisation: the harmonic energy of the inverse map, summed over target
/// triangles,
///
///   E = sum_t w_t psi(f_t),   f_t = |J_t|_F^2 / (2 det J_t),   psi(f) = f + (f / knee)^p,
///
/// where J_t maps target t linearly to its physical triangle (TargetShapes). f is 1 for a perfect
/// match and grows to infinity where a triangle degenerates: a barrier against inversion. The first
/// part of psi is Winslow's own functional and looks after the mean; the second weighs the worst
/// triangles, those with f near the knee and beyond. f does not depend on the size of either
/// triangle.
class VariationalWinslow final : public Formulation {
 public:
  /// threads: 0 for all cores; no result depends on it.
  VariationalWinslow(std::shared_ptr<const Topology> topology, const TargetShapes& shapes,
                     const PenaltyOptions& penalty, int threads);

  std::string_view name() const override { return "variational"; }
  /// R = -dE/dx at the free nodes; clip has no meaning here. Norms: of |R_i| over half the trace of
  /// node i's Hessian block and over its mean edge length, like the pointwise form's.
  ResidualNorms residual(const Coordinates& x, bool clip, std::span<double> out) const override;

  /// Infinite if a triangle is inverted or has no area (regularised: never).
  double energy(const Coordinates& x, const Regularisation* regularisation = nullptr) const;
  /// Largest f of any triangle; infinite if one is inverted.
  double worst_distortion(const Coordinates& x) const;
  /// R = -dE/dx (#free by 2) and -dR/dx as a symmetric matrix of 2x2 blocks. Regularised: the part
  /// of the Hessian that is positive semidefinite by construction, whatever `curvature`.
  Linearisation linearise(const Coordinates& x, Curvature curvature, SparseMatrix& out,
                          std::span<double> residual,
                          const Regularisation* regularisation = nullptr) const;
  /// Change of R (#free by 2), to first order, when the constrained nodes move by `displacement`
  /// (#nodes by 2; the free nodes' part is ignored).
  void boundary_response(const Coordinates& x, const Coordinates& displacement,
                         std::span<double> out) const;
  /// The targets, in an order of the formulation's own.
  const TargetShapes& shapes() const { return shapes_; }
  const PenaltyOptions& penalty() const { return penalty_; }
  /// Other targets of the same triangles, in the order of TargetShapes::build: the pattern stays
  /// the same object.
  void set_shapes(const TargetShapes& shapes);
  void set_penalty(const PenaltyOptions& penalty) { penalty_ = penalty; }
  int threads() const { return threads_; }

 private:
  struct BlockMemory;

  distortion::TriangleData data(const Coordinates& x, const Regularisation* regularisation) const;
  double sum_block(const distortion::TriangleData& data, bool project, bool with_matrix,
                   Index block, BlockMemory& memory) const;
  void add_projected(const distortion::TriangleData& data, std::span<const Index> triangles,
                     double* sums) const;
  template <typename Visit>
  void for_each_block(Visit&& visit) const;

  std::shared_ptr<const Topology> topology_;
  TargetShapes shapes_;
  PenaltyOptions penalty_;
  int threads_;
  std::vector<Index> row_of_node_;
  RowBlocks rows_;
  std::vector<Index> shape_order_;  // number in TargetShapes::build of each triangle of shapes_
  std::vector<Index> half_free_;    // triangles with free and constrained nodes
  const distortion::TriangleKernel& kernel_ = distortion::triangle_kernel();
};

}  // namespace winslow
