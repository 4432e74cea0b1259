#pragma once

#include "core/linear/linear_solver.h"
#include "core/outer/outer_solver.h"
#include "core/problem/smoothing_problem.h"

namespace winslow {

struct NewtonOptions {
  double tolerance = 1e-10;  ///< of the largest scaled residual (ResidualNorms::max)
  /// Relative residual of a linear solve; the most critical solves use at least 1e-6.
  double linear_tolerance = 1e-3;
};

/// Newton's method on an energy, from a valid mesh through valid meshes only.
///
/// Each step uses the exact Hessian if it is positive definite. If not, close to the solution the
/// diagonal is raised slightly: a few weak directions have negative curvature there, along which
/// the projected Hessian would converge slowly. Elsewhere the projected Hessian is used. The line
/// search starts below the exact largest valid step and requires sufficient decrease of the energy,
/// or of the residual when round-off hides the decrease of the energy.
class EnergyNewton final : public SteadySolver {
 public:
  /// The linear solver outlives this. memory: of an earlier one, see take_memory().
  EnergyNewton(std::shared_ptr<const EnergyProblem> problem, LinearSolver& linear,
               const NewtonOptions& options, std::vector<double> memory = {});
  /// The matrix's memory, for the next solver: new memory takes long to clear. Call nothing after.
  std::vector<double> take_memory() { return std::move(hessian_.values); }

  const SmoothingProblem& problem() const override { return *problem_; }
  /// The same, to keep it.
  const std::shared_ptr<const EnergyProblem>& shared_problem() const { return problem_; }
  /// Switches to another problem with the same number of unknowns. Call start() next.
  void set_problem(std::shared_ptr<const EnergyProblem> problem) { problem_ = std::move(problem); }

  /// Throws UsageError for a mesh with inverted elements.
  IterationRecord start(const Coordinates& x) override;
  IterationRecord step(Coordinates& x) override;
  bool converged() const override;
  /// True if the last step found no descent although the tolerance is not met, or the last 40 steps
  /// gained almost nothing: see stagnates().
  bool stalled() const override { return stalled_; }
  Index stuck_nodes() const override { return problem_->stuck_nodes(); }
  void count(MemoryUse& use) const override {
    use.matrix += bytes_of(hessian_.values);
    use.vectors += bytes_of(residual_, direction_) + linearised_at_.bytes();
  }

  void reject() override { linearised_.reset(); }

 private:
  double forcing() const;
  /// Whether an element is so near to inversion that only exact solves are reliable.
  bool slender() const { return record_.min_sine < 0.1; }
  void respond(const Coordinates& x, const Coordinates& displacement, bool correct,
               std::span<double> out) override;
  bool linearised() const { return linearised_ == problem_; }
  void factorise(const Coordinates& x);
  bool factorise_exact(const Coordinates& x, bool may_raise);
  bool try_matrix(bool keep);
  void factorise_projected(const Coordinates& x);
  double solve_for_direction(const Coordinates& x);
  /// A trial mesh of the line search.
  struct Trial {
    Coordinates x;
    double t;     // share of the direction
    double move;  // longest move of a node
    double energy;
  };
  Trial attempt(const Coordinates& x, double t) const;
  void lengthen(const Coordinates& x, double slope, Trial& trial) const;
  /// Returns false if no step of `shortest` or more lowers the energy.
  bool search(Coordinates& x, double slope, double shortest);
  bool stagnates(double slope) const;
  void assess(const Coordinates& x);

  std::shared_ptr<const EnergyProblem> problem_;
  LinearSolver& linear_;
  NewtonOptions options_;
  Validity validity_;  // of the present mesh
  SparseMatrix hessian_;
  std::vector<double> residual_, direction_;
  double tight_;  // tolerance of the linear solver if a looser one is insufficient
  double energy_ = 0;
  double round_off_ = 0;
  /// Energy and residual after a step.
  struct Reached {
    double energy, residual;
  };
  std::vector<Reached> reached_;  // for each step since start()
  // The problem whose factors the linear solver has, if any. The pointer keeps it alive, so that no
  // other problem can get the same address.
  std::shared_ptr<const EnergyProblem> linearised_;
  Coordinates linearised_at_;
  bool exact_ = true;  // the last factorisation was of the exact Hessian
  bool stalled_ = false;
};

}  // namespace winslow
