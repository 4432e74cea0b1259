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
  /// Far from a solution the steep penalty makes Newton's method creep: a gentle one first.
  void relax(Coordinates& x, double fraction) override;
};

}  // namespace winslow
