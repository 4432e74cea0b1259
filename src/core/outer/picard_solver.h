#pragma once

#include <memory>
#include <vector>

#include "core/linear/linear_solver.h"
#include "core/outer/outer_solver.h"

namespace winslow {

/// Fixed-point iteration with frozen coefficients (AIAA 2009-1362, section "Elliptic (Winslow)
/// Smoothing"): freeze alpha, beta, gamma and the weights, solve the linear system, take a damped
/// step x <- x + damping * delta.
///
/// Undamped it diverges even from a good mesh; with negative weights clipped every row is a convex
/// combination, which makes it the untangler.
class PicardSolver final : public OuterSolver {
 public:
  /// The three references outlive the solver.
  PicardSolver(const Topology& topology, const Formulation& formulation, LinearSolver& linear,
               const SmoothOptions& options);

  IterationRecord start(const Coordinates& x) override;
  IterationRecord step(Coordinates& x) override;
  bool converged() const override;

 private:
  bool choose_clip(Index inverted);
  void assess(const Coordinates& x);
  double apply_step(Coordinates& x) const;

  const Topology& topology_;
  const Formulation& formulation_;
  LinearSolver& linear_;
  SmoothOptions options_;
  SparseSystem system_;
  std::vector<double> delta_;
  IterationRecord record_;
  bool unclipped_before_ = false;
  int relapses_ = 0;  // times that going without clipping tangled a valid mesh
};

}  // namespace winslow
