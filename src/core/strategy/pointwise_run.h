#pragma once

#include "core/strategy/newton_run.h"

namespace winslow {

/// Moves the boundary of x and smooths by the paper's outer iteration. increments: number of
/// boundary steps; 0: one step and, if the result is tangled, more and more steps. If none gives a
/// valid mesh, the result is that of the single step, converged or not. rest: the mesh to which the
/// motion refers.
void move_by_fixed_point(const Coordinates& rest, const Motion& motion, int increments,
                         int max_iterations, OuterSolver& solver, RunRecorder& recorder,
                         Coordinates& x);

/// Smooths by the paper's operator and Newton's method.
///
/// OuterMethod::automatic: if Newton's method does not converge or does not complete the motion,
/// the paper's damped fixed point repeats everything from the start. (The operator's own solution
/// may be tangled, especially on quadrilaterals.) The result is the mesh of the fixed point, unless
/// that is tangled and Newton's is not.
class PointwiseRun final : public NewtonRun {
 public:
  /// The workspace is prepared. The references outlive the run.
  PointwiseRun(const MeshState& state, SmoothingWorkspace& workspace, RunRecorder& recorder)
      : NewtonRun(state, workspace, recorder) {}

  void smooth(Coordinates& x, double fraction, const Coordinates* reference) override;
  void move(const Motion& motion, const Coordinates& rest, int increments, Coordinates& x) override;

 private:
  using Way = std::function<void(Coordinates& x)>;

  SteadySolver& newton() override { return workspace().pointwise_newton(); }
  const LinearSolver& linear() override { return workspace().newton_linear(); }
  /// The equations may have no valid solution; then steps against the limit of validity only worsen
  /// the mesh.
  bool insists() const override { return false; }
  void attempt(const Way& by_newton, const Way& by_fixed_point, Coordinates& x);
};

}  // namespace winslow
