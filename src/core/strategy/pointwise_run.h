#pragma once

#include "core/motion/motion.h"
#include "core/outer/outer_solver.h"
#include "core/strategy/newton_run.h"
#include "core/strategy/run.h"

namespace winslow {

/// Moves the boundary of x and smooths by the paper's outer iteration. increments: steps in which
/// the boundary moves; 0: at once and, where that ends tangled, in more and more steps; where no
/// way leads to a valid mesh, the result is that of the direct way, converged or not. rest: what
/// the motion refers to.
void move_by_fixed_point(const Coordinates& rest, const Motion& motion, int increments,
                         int max_iterations, OuterSolver& solver, RunRecorder& recorder,
                         Coordinates& x);

/// Smooths by the paper's operator and Newton's method.
///
/// OuterMethod::automatic: if Newton's method does not converge, or does not complete the motion,
/// the paper's damped fixed point does all of it again from the start. (The operator's own solution
/// may be tangled, above all on quadrilaterals.) The result is the mesh of the fixed point; but if
/// that is tangled and Newton's is not, it is Newton's.
class PointwiseRun final : public NewtonRun {
 public:
  /// The workspace is prepared. The references outlive the run.
  PointwiseRun(const MeshState& state, SmoothingWorkspace& workspace, RunRecorder& recorder)
      : NewtonRun(state, workspace, recorder) {}

  void smooth(Coordinates& x, double fraction, const Coordinates* reference) override;
  void move_along_path(const Motion& motion, const Coordinates& rest, Coordinates& x) override;
  void move_in_steps(const Motion& motion, const Coordinates& rest, int increments,
                     Coordinates& x) override;

 private:
  using Way = std::function<void(Coordinates& x)>;

  SteadySolver& newton() override { return workspace().pointwise_newton(); }
  const LinearSolver& linear() override { return workspace().newton_linear(); }
  /// Without a solution to go to, steps against the limit of validity only spoil the mesh.
  bool insists() const override { return false; }
  void attempt(const Way& by_newton, const Way& by_fixed_point, Coordinates& x);
};

}  // namespace winslow
