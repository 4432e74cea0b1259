#pragma once

#include <memory>
#include <span>
#include <vector>

#include "core/formulation/row_blocks.h"
#include "core/formulation/target_shapes.h"
#include "core/problem/energy_problem.h"
#include "core/problem/node_problem.h"

namespace winslow {

/// Shape of psi.
struct PenaltyOptions {
  double exponent = 8;  ///< p >= 1
  double knee = 1.78;   ///< distortion f from which the power counts, > 1; 0: psi(f) = f^p

  bool operator==(const PenaltyOptions&) const = default;
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
///
/// The cells of UntanglingProblem are the target triangles. Residual norms are of |R_i| over half
/// the trace of node i's Hessian block and over its mean edge length, like the pointwise form's.
class VariationalWinslow final : public NodeProblem<UntanglingProblem> {
 public:
  /// classes: which nodes move. threads: 0 for all cores; no result depends on it. Throws
  /// UsageError for nodes that slide.
  VariationalWinslow(std::shared_ptr<const NodeClasses> classes, const TargetShapes& shapes,
                     const PenaltyOptions& penalty, int threads);

  /// The same with another penalty. What depends on the connectivity is shared; so are the targets.
  std::shared_ptr<const VariationalWinslow> with_penalty(const PenaltyOptions& penalty) const;
  /// The same with other targets of the same triangles, in the order of TargetShapes::build: the
  /// pattern stays the same object.
  std::shared_ptr<const VariationalWinslow> with_shapes(const TargetShapes& shapes) const;

  /// The same with other terms, in the order of shapes().
  std::shared_ptr<const VariationalWinslow> with_ordered_shapes(
      std::shared_ptr<const TargetShapes> shapes) const;

  std::string_view name() const override { return "variational"; }
  ResidualNorms residual(const Coordinates& x, std::span<double> out) const override;
  void boundary_response(const Coordinates& x, const Coordinates& displacement,
                         std::span<double> out) const override;

  double energy(const Coordinates& x) const override;
  /// 2x2 blocks, in the pattern of RowBlocks.
  Linearisation linearise(const Coordinates& x, Curvature curvature, SparseMatrix& hessian,
                          std::span<double> residual) const override;

  std::vector<double> cell_sizes(const Coordinates& x) const override;
  Regularisation regularisation(const Coordinates& x, std::span<const double> sizes,
                                double softness) const override;
  Regularisation full_regularisation(const Coordinates& x) const override;
  double regularised_energy(const Coordinates& x,
                            const Regularisation& regularisation) const override;
  Linearisation linearise_regularised(const Coordinates& x, const Regularisation& regularisation,
                                      SparseMatrix& hessian,
                                      std::span<double> residual) const override;

  /// Largest f of any triangle; infinite if one is inverted.
  double worst_distortion(const Coordinates& x) const;
  /// The targets, in an order of the formulation's own.
  const TargetShapes& shapes() const { return *shapes_; }
  const PenaltyOptions& penalty() const { return penalty_; }

 private:
  struct Structure;
  struct BlockMemory;

  distortion::TriangleData data(const Coordinates& x, const Regularisation* regularisation) const;
  double energy_of(const distortion::TriangleData& triangles) const;
  Linearisation assemble(const distortion::TriangleData& triangles, bool project,
                         SparseMatrix& hessian, std::span<double> residual) const;
  double sum_block(const distortion::TriangleData& data, bool project, bool with_matrix,
                   Index block, BlockMemory& memory) const;
  void add_projected(const distortion::TriangleData& data, std::span<const Index> triangles,
                     double* sums) const;
  template <typename Visit>
  void for_each_block(Visit&& visit) const;

  std::shared_ptr<const Structure> structure_;
  std::shared_ptr<const TargetShapes> shapes_;
  PenaltyOptions penalty_;
  const distortion::TriangleKernel& kernel_ = distortion::triangle_kernel();
};

}  // namespace winslow
