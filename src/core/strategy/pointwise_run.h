#pragma once

#include <functional>

#include "core/strategy/newton_run.h"

namespace winslow {

/// Smooths by the paper's operator and Newton's method.
///
/// OuterMethod::automatic: where that does not end converged with the whole motion done (the
/// operator's own solution may be tangled, on quadrilaterals above all), the paper's damped fixed
/// point does it all again from the start. Its mesh is the result unless it is tangled and
/// Newton's, though it falls short, is not.
class PointwiseRun final : public NewtonRun {
 public:
  /// The workspace is prepared. The references outlive the run.
  PointwiseRun(const MeshState& state, SmoothingWorkspace& workspace, RunRecorder& recorder)
      : NewtonRun(state, workspace, recorder) {}

  void smooth(Coordinates& x, double fraction, const Coordinates* reference) override;
  void follow(const Motion& motion, const Coordinates& rest, Coordinates& x) override;
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
