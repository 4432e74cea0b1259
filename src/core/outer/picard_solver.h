#pragma once

#include <deque>

#include "core/linear/linear_solver.h"
#include "core/outer/outer_solver.h"
#include "core/problem/smoothing_problem.h"

namespace winslow {

/// Anderson acceleration of a fixed-point iteration x <- x + f(x): the next iterate is the
/// combination of the last few for which the step would vanish if f were linear (D. G. Anderson, J.
/// ACM 12, 1965; the type II form of H. Walker and P. Ni, SIAM J. Numer. Anal. 49, 2011).
class AndersonAcceleration {
 public:
  /// depth: number of earlier iterates combined. weights: one per unknown, for the norm of the step
  /// (here: 1 / local edge length, so that far-field cells do not dominate wall cells).
  AndersonAcceleration(int depth, std::vector<double> weights);

  /// Replaces the step f at x by the accelerated one, and stores x and f.
  void accelerate(std::span<const double> x, std::span<double> step);
  /// Forgets everything (after the equations changed).
  void reset();
  std::size_t bytes() const {
    const std::size_t vectors = 3 + x_differences_.size() + step_differences_.size();
    return vectors * static_cast<std::size_t>(weights_.size()) * sizeof(double);
  }

 private:
  std::size_t depth_;
  Eigen::VectorXd weights_;
  Eigen::VectorXd last_x_, last_step_;
  std::deque<Eigen::VectorXd> x_differences_, step_differences_;
};

/// Fixed-point iteration with frozen coefficients (AIAA 2009-1362, section "Elliptic (Winslow)
/// Smoothing"): freeze alpha, beta, gamma and the weights, solve the linear system, take a damped
/// step x <- x + damping * delta.
///
/// Without damping the iteration diverges even from a good mesh. With negative weights clipped
/// every row is a convex combination, so the iteration untangles. Once the mesh is valid the steps
/// are accelerated, and an accelerated step that would invert an element is replaced by the plain
/// one.
class PicardSolver final : public OuterSolver {
 public:
  /// The linear solver outlives this.
  PicardSolver(ClipVariants<FixedPointProblem> problems, LinearSolver& linear,
               const EquationOptions& options);

  IterationRecord start(const Coordinates& x) override;
  IterationRecord step(Coordinates& x) override;
  bool converged() const override;
  void count(MemoryUse& use) const override {
    use.matrix += bytes_of(system_.matrix.values);
    use.vectors += bytes_of(system_.rhs) + (acceleration_ ? acceleration_->bytes() : 0);
  }

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
  double round_off_ = 0;  // smallest residual that double precision can show on this mesh

  bool unclipped_before_ = false;
  int relapses_ = 0;  // how often steps without clipping tangled a valid mesh

  std::optional<AndersonAcceleration> acceleration_;
  double best_accelerated_ = 0;

  double best_residual_ = 0;  // for adapt_damping
  Index least_inverted_ = 0;
  int last_progress_ = 0;  // iteration
};

}  // namespace winslow
