#pragma once

#include "core/linear/linear_solver.h"
#include "core/outer/outer_solver.h"
#include "core/problem/smoothing_problem.h"

namespace winslow {

/// Newton's method on equations without an energy, semismooth where negative weights are clipped.
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
class EquationNewton final : public SteadySolver {
 public:
  /// The linear solver outlives this.
  EquationNewton(ClipVariants<EquationProblem> problems, LinearSolver& linear,
                 const EquationOptions& options);

  const SmoothingProblem& problem() const override { return *present(); }

  /// Throws UsageError for a mesh with inverted elements under Clip::off, NumericError for
  /// coordinates that are not finite.
  IterationRecord start(const Coordinates& x) override;
  IterationRecord step(Coordinates& x) override;
  bool converged() const override;
  /// True if the last step found no way down, or none but into the limit of validity: mostly the
  /// equations have no valid solution there. It left the mesh as it was.
  bool stalled() const override { return stalled_; }

  void reject() override { linearised_.reset(); }

 private:
  const std::shared_ptr<const EquationProblem>& present() const {
    return problems_.of(record_.clipped);
  }
  void factorise(const Coordinates& x);
  void solve(std::span<const double> rhs, int columns, std::span<double> out);
  bool solve_newton(const Coordinates& x);
  bool search(Coordinates& x, std::span<const double> direction, double first, double smallest);
  bool search_frozen(Coordinates& x);
  void assess(const Coordinates& x);
  void respond(const Coordinates& x, const Coordinates& displacement, bool correct,
               std::span<double> out) override;

  ClipVariants<EquationProblem> problems_;
  LinearSolver& linear_;
  EquationOptions options_;
  SparseMatrix jacobian_;
  SparseSystem frozen_;
  std::vector<double> residual_, direction_, frozen_direction_;
  std::vector<double> merit_weights_;
  double round_off_ = 0;
  // What the linear solver has the factors of, if it has any.
  std::shared_ptr<const EquationProblem> linearised_;
  Coordinates linearised_at_;
  bool stalled_ = false;
};

}  // namespace winslow
