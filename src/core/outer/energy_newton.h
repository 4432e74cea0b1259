#pragma once

#include "core/linear/linear_solver.h"
#include "core/outer/outer_solver.h"
#include "core/problem/smoothing_problem.h"

namespace winslow {

struct NewtonOptions {
  double tolerance = 1e-10;  ///< of the largest scaled residual (ResidualNorms::max)
  /// Relative residual of a linear solve; those that matter most go to 1e-6 in any case.
  double linear_tolerance = 1e-3;
};

/// Newton's method on an energy, from a valid mesh and through valid meshes only.
///
/// Each step: the exact Hessian, or where that is not positive definite, close to the solution
/// one with a slightly raised diagonal (a few weak directions bend the wrong way there, and the
/// projected one would creep along them), else the projected one; a line
/// search that starts below the exact largest valid step and demands sufficient decrease of the
/// energy, or, where the energy no longer shows it (round-off), of the residual.
class EnergyNewton final : public SteadySolver {
 public:
  /// The linear solver outlives this.
  EnergyNewton(std::shared_ptr<const EnergyProblem> problem, LinearSolver& linear,
               const NewtonOptions& options);

  const SmoothingProblem& problem() const override { return *problem_; }
  /// Goes over to another problem with as many unknowns. start() comes next.
  void set_problem(std::shared_ptr<const EnergyProblem> problem) { problem_ = std::move(problem); }

  /// Throws UsageError for a mesh with inverted elements.
  IterationRecord start(const Coordinates& x) override;
  IterationRecord step(Coordinates& x) override;
  bool converged() const override;
  /// True if the last step found no way down although the tolerance is not met, or the last 40 of
  /// them have gained next to nothing: see stagnates().
  bool stalled() const override { return stalled_; }
  Index stuck_nodes() const override { return problem_->stuck_nodes(); }

  void reject() override { linearised_.reset(); }

 private:
  double forcing() const;
  /// Whether an element is so near to inversion that only exact solves are to be trusted.
  bool slender() const { return record_.min_sine < 0.1; }
  void respond(const Coordinates& x, const Coordinates& displacement, bool correct,
               std::span<double> out) override;
  bool linearised() const { return linearised_ == problem_; }
  void factorise(const Coordinates& x);
  bool factorise_exact(const Coordinates& x, bool may_raise);
  bool try_matrix(bool keep);
  void factorise_projected(const Coordinates& x);
  double solve_for_direction(const Coordinates& x);
  /// A mesh that the line search looks at.
  struct Trial {
    Coordinates x;
    double t;     // share of the direction
    double move;  // longest of a node
    double energy;
  };
  Trial attempt(const Coordinates& x, double t) const;
  void lengthen(const Coordinates& x, double slope, Trial& trial) const;
  /// False if no step of `shortest` or more leads down.
  bool search(Coordinates& x, double slope, double shortest);
  bool stagnates(double slope) const;
  void assess(const Coordinates& x);

  std::shared_ptr<const EnergyProblem> problem_;
  LinearSolver& linear_;
  NewtonOptions options_;
  Validity validity_;  // of the mesh
  SparseMatrix hessian_;
  std::vector<double> residual_, direction_;
  double tight_;  // tolerance of the linear solver where a looser one would not do
  double energy_ = 0;
  double round_off_ = 0;
  /// Where a step has led.
  struct Reached {
    double energy, residual;
  };
  std::vector<Reached> reached_;  // by each step since start()
  // What the linear solver has the factors of, if it has any: that keeps the object alive, so that
  // no other problem can pass for it.
  std::shared_ptr<const EnergyProblem> linearised_;
  Coordinates linearised_at_;
  bool exact_ = true;  // the last factorisation was of the exact Hessian
  bool stalled_ = false;
};

}  // namespace winslow
