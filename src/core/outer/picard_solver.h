#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "core/linear/linear_solver.h"
#include "core/outer/anderson.h"
#include "core/outer/equation_options.h"
#include "core/outer/outer_solver.h"
#include "core/problem/equation_problem.h"

namespace winslow {

/// Fixed-point iteration with frozen coefficients (AIAA 2009-1362, section "Elliptic (Winslow)
/// Smoothing"): freeze alpha, beta, gamma and the weights, solve the linear system, take a damped
/// step x <- x + damping * delta.
///
/// Undamped it diverges even from a good mesh; with negative weights clipped every row is a convex
/// combination, which makes it the untangler. Once the mesh is valid the steps are accelerated, and
/// an accelerated step that would invert an element is replaced by the plain one.
class PicardSolver final : public OuterSolver {
 public:
  /// The linear solver outlives this.
  PicardSolver(ClipVariants<FixedPointProblem> problems, LinearSolver& linear,
               const EquationOptions& options);

  IterationRecord start(const Coordinates& x) override;
  IterationRecord step(Coordinates& x) override;
  bool converged() const override;
  int linear_solves() const override { return linear_solves_; }

 private:
  bool choose_clip(Index inverted);
  void assess(const Coordinates& x);
  void adapt_damping();
  bool accelerate(const Coordinates& x, std::vector<double>& step);
  /// The equations as they are solved at present.
  const FixedPointProblem& problem() const { return *problems_.of(record_.clipped); }

  ClipVariants<FixedPointProblem> problems_;
  LinearSolver& linear_;
  EquationOptions options_;
  SparseSystem system_;
  IterationRecord record_;
  double round_off_ = 0;  // smallest residual that double precision can show on this mesh

  bool unclipped_before_ = false;
  int relapses_ = 0;  // times that going without clipping tangled a valid mesh

  std::optional<AndersonAcceleration> acceleration_;
  double best_accelerated_ = 0;

  int linear_solves_ = 0;

  double best_residual_ = 0;  // for adapt_damping
  Index least_inverted_ = 0;
  int last_progress_ = 0;  // iteration
};

}  // namespace winslow
