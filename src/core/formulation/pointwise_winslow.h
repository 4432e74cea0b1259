#pragma once

#include "core/formulation/stencil_operator.h"
#include "core/problem/node_unknowns.h"
#include "core/problem/smoothing_problem.h"

namespace winslow {

/// The part of the pointwise form that depends only on the connectivity and the moving nodes. Forms
/// with other VCVs share it, so a linear solver can reuse its work on the pattern.
struct PointwisePattern {
  /// classes: which nodes move. threads: 0 for all cores; no result depends on it. Throws
  /// UsageError for nodes that slide.
  PointwisePattern(std::shared_ptr<const NodeClasses> classes, int threads);

  NodeUnknowns nodes;
  std::shared_ptr<const NodePattern> rows;
};

/// The paper's operator (AIAA 2009-1362, equation 2 and sections IV and V, in integral form over
/// each VCV). In the plane
///
///   alpha r_xx - 2 beta r_xy + gamma r_yy = 0,
///   alpha = |r_y|^2,  beta = r_x . r_y,  gamma = |r_x|^2,
///
/// in space K : (second derivatives of r) = 0, K = adj(G^T G), G = [r_x r_y r_z]. With nodal
/// coefficients outside the integral, divided by their mean, this is at every free node
///
///   R = sum_k w_k (r_k - r_0) = 0,
///
/// w_k the coefficients times the flux functionals of neighbour k. Clipped: with negative weights
/// set to zero.
template <int D>
class PointwiseForm final : public NodeProblem<EquationProblem> {
 public:
  using Operator = StencilOperator<D>;
  using Vcvs = typename Operator::Vcvs;

  /// Arguments as for PointwisePattern.
  PointwiseForm(const Vcvs& vcvs, std::shared_ptr<const NodeClasses> classes, int threads,
                bool clipped = false)
      : PointwiseForm(vcvs, PointwisePattern(std::move(classes), threads), clipped) {}
  PointwiseForm(const Vcvs& vcvs, const PointwisePattern& pattern, bool clipped = false);

  /// The same with negative weights set to zero, or with all weights as they are.
  PointwiseForm clipped(bool clip) const;

  std::string_view name() const override { return "pointwise"; }
  ResidualNorms residual(const Coordinates& x, std::span<double> out) const override;
  /// The matrix is the same for all coordinates; its rows are scaled by row_scales().
  Index freeze(const Coordinates& x, SparseSystem& out) const override;

  /// Newton's system J delta = S R: the exact J = -S dR/dx as an unsymmetric matrix of D by D
  /// blocks (pattern of NodePattern) and S R (#free by D), a length. S holds the row_scales() at x
  /// and is treated as constant. The derivative of R includes the division of the coefficients by
  /// their mean. Clipped: edges with negative weights do not contribute to the derivative of the
  /// weights (an element of the generalised Jacobian, L. Qi and J. Sun, "A nonsmooth version of
  /// Newton's method", Math. Program. 58, 1993). A row without weights becomes an identity row.
  /// Returns the norms of R as residual() does.
  ResidualNorms linearise(const Coordinates& x, SparseMatrix& jacobian,
                          std::span<double> residual) const override;
  void boundary_response(const Coordinates& x, const Coordinates& displacement,
                         std::span<double> out) const override;
  /// For each free node: row_scales() divided by its mean edge length.
  std::vector<double> merit_weights(const Coordinates& x) const override;
  double merit(const Coordinates& x, std::span<const double> weights) const override;

  /// Row scale factors 1 / sum_k |w_k| at every free node (#free): they scale R to about the
  /// distance by which the node alone would move. 1 where all weights are zero.
  void row_scales(const Coordinates& x, std::span<double> out) const;
  /// Coefficients at a free node; those of the Laplacian if the nodal gradient vanishes.
  typename Operator::Coefficients coefficients(const Coordinates& x, Index node) const;
  /// Weights of a free node's neighbours (#neighbours). Returns the number of negative ones; the
  /// clipped form sets them to zero.
  Index weights(const Coordinates& x, Index node, std::span<double> out) const;

 private:
  using Matrix = typename Operator::Matrix;
  class RowDerivative;

  Matrix gradient(const Coordinates& x, Index node) const;
  Index evaluate_weights(const Coordinates& x, Index node, bool clip, std::span<double> out) const;
  template <typename Visit>
  void each_node(Visit&& visit) const;
  template <typename Visit>
  void each_row(const Coordinates& x, Visit&& visit) const;

  std::shared_ptr<const typename Operator::Functionals> functionals_;
  std::shared_ptr<const NodePattern> pattern_;
  bool clip_;
};

/// For plane meshes, and for volume meshes.
using PointwiseWinslow = PointwiseForm<2>;
using VolumePointwise = PointwiseForm<3>;

/// Both variants of a pointwise problem.
template <int D>
ClipVariants<EquationProblem> clip_variants(const PointwiseForm<D>& problem) {
  return {std::make_shared<const PointwiseForm<D>>(problem.clipped(false)),
          std::make_shared<const PointwiseForm<D>>(problem.clipped(true))};
}

}  // namespace winslow
