#pragma once

#include "core/linear/linear_solver.h"
#include "core/outer/outer_solver.h"
#include "core/problem/smoothing_problem.h"

namespace winslow {

/// The initial interior of an untangling.
enum class Interior {
  as_given,
  /// Harmonic for the given boundary: the minimiser in the limit of infinite regularisation,
  /// independent of the given interior.
  harmonic
};

/// Untangles by an energy with a regularised determinant in place of the barrier (Regularisation):
/// Newton steps with the part of the Hessian that is positive semidefinite by construction. Before
/// each step the regularisation is chosen from the inverted cells. It becomes sharper where the
/// number of inverted elements no longer falls. Where the mesh comes to rest it becomes sharper for
/// inverted cells, too: their energy grows until it exceeds that of all valid cells, however flat
/// these are.
class EnergyUntangler final : public OuterSolver {
 public:
  /// linear_tolerance: relative residual of a linear solve, tightened to 1e-6; in space ten times
  /// it, but for the harmonic interior. reference: coordinates that give the sizes of the cells,
  /// e.g. the mesh before its boundary moved; null: the initial mesh. It and the linear solver
  /// outlive this object. The first step computes a harmonic interior if chosen.
  EnergyUntangler(std::shared_ptr<const UntanglingProblem> problem, LinearSolver& linear,
                  double linear_tolerance, const Coordinates* reference, Interior interior);

  IterationRecord start(const Coordinates& x) override;
  IterationRecord step(Coordinates& x) override;
  /// True once no element is inverted.
  bool converged() const override { return record_.inverted == 0; }
  /// True once the sharpest regularisation has not helped either.
  bool stalled() const override;

 private:
  double forcing() const;
  void measure_sizes(const Coordinates& x);
  /// Whether the present or the coming first step computes the harmonic interior.
  bool harmonic_step() const { return interior_ == Interior::harmonic && record_.iteration <= 1; }
  void choose_regularisation(const Coordinates& x);
  void sharpen(bool at_rest);
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
  Softness softness_;
  Index least_inverted_ = 0;
  int last_progress_ = 0;  // iteration
  SparseMatrix hessian_;
  std::vector<double> direction_;
};

}  // namespace winslow
