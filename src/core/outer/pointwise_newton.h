#pragma once

#include "core/formulation/pointwise_winslow.h"
#include "core/linear/linear_solver.h"
#include "core/outer/smooth_options.h"
#include "core/outer/steady_solver.h"

namespace winslow {

/// Newton's method on the paper's operator, semismooth where negative weights are clipped.
///
/// Each step: the exact Jacobian; a line search that demands decrease of the root mean square of
/// the scaled nodal residuals, the scales held at the values they have where the step begins (only
/// then is the Newton direction one of descent). Once the mesh is valid the search starts below the
/// exact largest valid step, so that no accepted step inverts an element. Where Newton's step would
/// have to be cut very short, or the Jacobian is singular, the solution with frozen coefficients,
/// damped as in PicardSolver, is tried in its place.
///
/// Clip::automatic: clipped while the mesh is tangled. A tangled mesh often comes untangled, but
/// not surely; PicardSolver is the untangler.
class PointwiseNewton final : public SteadySolver {
 public:
  /// The three references outlive the solver.
  PointwiseNewton(const Topology& topology, const PointwiseWinslow& formulation,
                  LinearSolver& linear, const SmoothOptions& options);

  /// Throws UsageError for a mesh with inverted elements under Clip::off, NumericError for
  /// coordinates that are not finite.
  IterationRecord start(const Coordinates& x) override;
  IterationRecord step(Coordinates& x) override;
  bool converged() const override;
  /// True if the last step found no way down, or none but into the limit of validity: mostly the
  /// equations have no valid solution there. It left the mesh as it was.
  bool stalled() const override { return stalled_; }

  void predict(const Coordinates& x, const Coordinates& displacement,
               std::span<double> out) override;
  void forget_factorisation() override { factorised_ = false; }
  int linear_solves() const override { return linear_solves_; }

 private:
  void factorise(const Coordinates& x);
  void weigh(const Coordinates& x);
  double merit(const Coordinates& x);
  void solve(std::span<const double> rhs, int columns, std::span<double> out);
  bool solve_newton(const Coordinates& x);
  bool search(Coordinates& x, std::span<const double> direction, double first, double smallest);
  bool search_frozen(Coordinates& x);
  void assess(const Coordinates& x);

  const Topology& topology_;
  const PointwiseWinslow& formulation_;
  LinearSolver& linear_;
  SmoothOptions options_;
  IterationRecord record_;
  SparseMatrix jacobian_;
  SparseSystem frozen_;
  std::vector<double> residual_, direction_, frozen_direction_;
  std::vector<double> merit_weights_;  // #free, per unit of the unscaled residual
  std::vector<double> scratch_;        // #free by 2
  double round_off_ = 0;
  Coordinates factorised_at_;
  bool factorised_ = false;
  bool factorised_clipped_ = false;
  bool stalled_ = false;
  int linear_solves_ = 0;
};

}  // namespace winslow
