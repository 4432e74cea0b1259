#pragma once

#include "core/linear/linear_solver.h"
#include "core/outer/outer_solver.h"
#include "core/problem/smoothing_problem.h"

namespace winslow {

/// Where an untangling begins.
enum class Interior {
  as_given,
  /// Harmonic within the boundary: the minimiser as the regularisation goes to infinity, whatever
  /// the interior was.
  harmonic
};

/// Untangles by an energy with a regularised determinant in place of the barrier (Regularisation):
/// Newton steps on the part of the Hessian that is positive semidefinite by construction, the
/// regularisation chosen anew from the worst cells before each.
class EnergyUntangler final : public OuterSolver {
 public:
  /// linear_tolerance: relative residual of a linear solve, tightened to 1e-6. reference:
  /// coordinates that say how large the cells are to be, e.g. the mesh before its boundary moved;
  /// null: those that the untangling begins from. It and the linear solver outlive this. A
  /// harmonic interior is the first step.
  EnergyUntangler(std::shared_ptr<const UntanglingProblem> problem, LinearSolver& linear,
                  double linear_tolerance, const Coordinates* reference, Interior interior);

  IterationRecord start(const Coordinates& x) override;
  IterationRecord step(Coordinates& x) override;
  /// True once no element is inverted.
  bool converged() const override { return record_.inverted == 0; }
  bool stalled() const override { return record_.damping == 0; }

 private:
  double forcing() const;
  void measure_sizes(const Coordinates& x);
  /// The present step, or the first one to come, is the one to the harmonic interior.
  bool harmonic_step() const { return interior_ == Interior::harmonic && record_.iteration <= 1; }
  void choose_regularisation(const Coordinates& x);
  void assess(const Coordinates& x);
  double solve_for_direction(const Coordinates& x);
  bool search(Coordinates& x, double slope, double shortest);

  std::shared_ptr<const UntanglingProblem> problem_;
  LinearSolver& linear_;
  double linear_tolerance_;
  const Coordinates* reference_;
  Interior interior_;
  std::vector<double> sizes_;  // of the cells
  Regularisation regularisation_;
  double softness_ = 0;  // share of a cell's size by which its determinant is regularised
  Index least_inverted_ = 0;
  int last_progress_ = 0;  // iteration
  SparseMatrix hessian_;
  std::vector<double> direction_;
};

}  // namespace winslow
