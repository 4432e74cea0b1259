#pragma once

#include "core/command/newton_run.h"

namespace winslow {

/// Smooths by the variational form.
class VariationalRun final : public NewtonRun {
 public:
  /// The workspace is prepared. The references outlive the run.
  VariationalRun(const MeshState& state, SmoothingWorkspace& workspace, RunRecorder& recorder)
      : NewtonRun(state, workspace, recorder) {}

 private:
  SteadySolver& newton() override { return workspace().newton(); }
  const LinearSolver& linear() override { return workspace().symmetric_linear(); }
  /// Far from a solution the steep penalty makes Newton's method creep: a gentle one first. Where
  /// even the mesh that this leads to has elements far beyond the knee, the knee is doubled until
  /// it has none: a rule that depends on where the boundary is, not on the way there.
  void relax(Coordinates& x, double fraction) override;
  bool strained(const Coordinates& x) override;

  double knee();
};

}  // namespace winslow
