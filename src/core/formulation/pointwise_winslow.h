#pragma once

#include <memory>
#include <vector>

#include "core/formulation/nodal_operator.h"
#include "core/formulation/node_pattern.h"
#include "core/problem/equation_problem.h"
#include "core/problem/node_problem.h"
#include "core/vcv/stencil_functionals.h"
#include "core/vcv/virtual_control_volumes.h"

namespace winslow {

/// The paper's operator (AIAA 2009-1362, equation 2, in integral form over each VCV):
///
///   alpha r_xx - 2 beta r_xy + gamma r_yy = 0,
///   alpha = |r_y|^2,  beta = r_x . r_y,  gamma = |r_x|^2,
///
/// with nodal coefficients outside the integral, so that at every free node
///
///   sum_k w_k (r_k - r_0) = 0,   w_k = alpha lxx_k - beta lxy_k + gamma lyy_k.
///
/// Clipped: with negative weights set to zero.
class PointwiseWinslow final : public NodeProblem<EquationProblem> {
 public:
  /// classes: which nodes move. threads: 0 for all cores; no result depends on it. Throws
  /// UsageError for nodes that slide.
  PointwiseWinslow(const VirtualControlVolumes& vcv, std::shared_ptr<const NodeClasses> classes,
                   int threads, bool clipped = false);

  /// The same with negative weights set to zero, or with all weights as they are.
  PointwiseWinslow clipped(bool clip) const;
  /// The same over other VCVs of the same topology; the pattern stays the same object.
  PointwiseWinslow with_vcvs(const VirtualControlVolumes& vcv) const;

  std::string_view name() const override { return "pointwise"; }
  ResidualNorms residual(const Coordinates& x, std::span<double> out) const override;
  Index freeze(const Coordinates& x, SparseSystem& out) const override;

  /// Newton's system J delta = S R: the exact J = -S dR/dx as an unsymmetric matrix of 2x2 blocks
  /// (pattern of NodePattern) and S R (#free by 2), a length. S holds the row_scales() at x and
  /// counts as constant. R is differentiated as residual() gives it, the division of the
  /// coefficients by (alpha + gamma) / 2 included. Clipped: edges with negative weights are left
  /// out of the derivative of the weights, too (an element of the generalised Jacobian, L. Qi and
  /// J. Sun, "A nonsmooth version of Newton's method", Math. Program. 58, 1993). A row without
  /// weights becomes that of the identity. Returns the norms of R as residual() does.
  ResidualNorms linearise(const Coordinates& x, SparseMatrix& jacobian,
                          std::span<double> residual) const override;
  void boundary_response(const Coordinates& x, const Coordinates& displacement,
                         std::span<double> out) const override;
  /// Of each free node: row_scales() over its mean edge.
  std::vector<double> merit_weights(const Coordinates& x) const override;
  double merit(const Coordinates& x, std::span<const double> weights) const override;

  /// 1 / sum_k |w_k| at every free node (#free), by which rows are multiplied: it takes R to the
  /// size of the distance by which the node alone would move. 1 where all weights are zero.
  void row_scales(const Coordinates& x, std::span<double> out) const;
  /// Coefficients at a free node. Where the nodal Jacobian vanishes: those of the Laplacian.
  WinslowCoefficients coefficients(const Coordinates& x, Index node) const;
  /// Weights of a free node's neighbours (as many as it has). Returns the number of negative ones;
  /// clipped, they are set to zero.
  Index weights(const Coordinates& x, Index node, std::span<double> out) const;

 private:
  class RowDerivative;

  Index evaluate_weights(const Coordinates& x, Index node, bool clip, std::span<double> out) const;

  std::shared_ptr<const StencilFunctionals> functionals_;
  std::shared_ptr<const NodePattern> pattern_;
  bool clip_;
};

/// Both variants of a pointwise problem.
ClipVariants<PointwiseWinslow> clip_variants(const PointwiseWinslow& problem);

}  // namespace winslow
