#pragma once

#include "core/linear/linear_solver.h"
#include "core/outer/outer_solver.h"
#include "core/problem/smoothing_problem.h"

namespace winslow {

/// Newton's method on equations without an energy, semismooth if negative weights are clipped.
///
/// Each step uses the exact Jacobian and a line search that requires a decrease of the root mean
/// square of the scaled nodal residuals. The scales are constant during the step (only then is the
/// Newton direction one of descent). Once the mesh is valid the search starts below the exact
/// largest valid step, so that no accepted step inverts an element. If the Newton step would be
/// very short, or the Jacobian is singular, the step to the solution with frozen coefficients,
/// damped as in PicardSolver, is tried instead.
///
/// Clip::automatic: clipped while the mesh is tangled. This often untangles a mesh, but not
/// reliably; use PicardSolver for untangling.
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
  /// True if the last step found no descent, or only towards the limit of validity: usually the
  /// equations then have no valid solution. The mesh is left unchanged.
  bool stalled() const override { return stalled_; }
  void count(MemoryUse& use) const override {
    use.matrix += bytes_of(jacobian_.values, frozen_.matrix.values);
    use.vectors += linearised_at_.bytes() +
                   bytes_of(residual_, direction_, frozen_direction_, merit_weights_, frozen_.rhs);
  }

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
  // The problem whose factors the linear solver has, if any.
  std::shared_ptr<const EquationProblem> linearised_;
  Coordinates linearised_at_;
  bool stalled_ = false;
};

}  // namespace winslow
