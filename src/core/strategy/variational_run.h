#pragma once

#include <optional>

#include "core/formulation/target_path.h"
#include "core/strategy/newton_run.h"

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
  void begin_anew() override;
  /// Far from a solution the steep penalty makes Newton's method creep: a gentle one first. Where
  /// even the mesh that this leads to has elements far beyond the knee, the knee is doubled until
  /// it has none.
  void relax(Coordinates& x, double fraction, const RunRecorder::Enough& enough) override;
  bool has_targets() const override { return true; }
  void vary_targets(const Coordinates& from) override;
  void set_target_share(double share) override;
  /// The mesh that the knee was doubled for was not a solution yet: a solution may do with less.
  bool sharpen(const Coordinates& x) override;
  bool strained(const Coordinates& x) override;

  const PenaltyOptions& asked_for() { return workspace().options().penalty; }
  double knee();
  /// The penalty asked for, with a knee that no element is far beyond.
  PenaltyOptions fitting(const Coordinates& x);
  /// Newton's method is on the energy with this penalty from here on.
  void change_penalty(const PenaltyOptions& penalty);

  const VariationalForm& energy();

  std::shared_ptr<const VariationalForm> energy_;  // that newton() is on; null: not made yet
  std::unique_ptr<const TargetPath> target_path_;
};

}  // namespace winslow
