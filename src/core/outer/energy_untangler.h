#pragma once

#include <vector>

#include "core/formulation/variational_winslow.h"
#include "core/linear/linear_solver.h"
#include "core/outer/outer_solver.h"
#include "core/outer/smooth_options.h"

namespace winslow {

/// Where an untangling begins.
enum class Interior {
  as_given,
  /// Harmonic within the boundary: the minimiser as the regularisation goes to infinity, whatever
  /// the interior was.
  harmonic
};

/// Untangles by the variational form with a regularised determinant in place of the barrier
/// (Regularisation): Newton steps on the part of the Hessian that is positive semidefinite by
/// construction, the regularisation chosen anew from the worst triangles before each.
class EnergyUntangler final : public OuterSolver {
 public:
  /// reference: coordinates whose triangle areas say how large the triangles are to be, e.g. the
  /// mesh before its boundary moved; null: those that the untangling begins from. The references
  /// outlive the solver. A harmonic interior is the first step.
  EnergyUntangler(const Topology& topology, const VariationalWinslow& formulation,
                  LinearSolver& linear, const SmoothOptions& options, const Coordinates* reference,
                  Interior interior);

  IterationRecord start(const Coordinates& x) override;
  IterationRecord step(Coordinates& x) override;
  /// True once no element is inverted.
  bool converged() const override { return record_.inverted == 0; }
  bool stalled() const override { return record_.damping == 0; }
  int linear_solves() const override { return linear_solves_; }

 private:
  void measure_sizes(const Coordinates& x);
  /// The step in hand, or the first one to come, is the one to the harmonic interior.
  bool harmonic_step() const { return interior_ == Interior::harmonic && record_.iteration <= 1; }
  void regularise_away(const Coordinates& x);
  void choose_regularisation(const Coordinates& x);
  void assess(const Coordinates& x);

  const Topology& topology_;
  const VariationalWinslow& formulation_;
  LinearSolver& linear_;
  SmoothOptions options_;
  IterationRecord record_;
  const Coordinates* reference_;
  Interior interior_;
  std::vector<double> sizes_;  // determinant of each triangle
  Regularisation regularisation_;
  double softness_ = 0;  // share of a triangle's size by which its determinant is regularised
  Index least_inverted_ = 0;
  int last_progress_ = 0;  // iteration
  SparseMatrix hessian_;
  int linear_solves_ = 0;
};

}  // namespace winslow
