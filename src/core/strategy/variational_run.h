#pragma once

#include "core/formulation/target_path.h"
#include "core/outer/energy_descent.h"
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
  /// Far from a solution the steep penalty slows Newton's method down, so a gentle one comes first.
  /// If its mesh still has elements far beyond the knee, the knee is doubled until none is.
  void relax(Coordinates& x, double fraction, const RunRecorder::Enough& enough) override;
  bool descends() override;
  bool descend(Coordinates& x, double fraction, int limit,
               const RunRecorder::Enough& enough) override;
  bool has_targets() const override { return true; }
  void vary_targets(const Coordinates& from) override;
  void set_target_share(double share) override;
  /// The knee was doubled for a mesh that was no solution yet: a solution may permit less.
  bool sharpen(const Coordinates& x) override;
  bool strained(const Coordinates& x) override;
  /// Guards come into effect at the end of a path.
  void begin_path() override;
  void leave_path() override { on_path_ = false; }
  bool on_path() const override { return on_path_; }

  const PenaltyOptions& asked_for() { return workspace().options().penalty; }
  /// Largest distortion in knees: VariationalForm::strain().
  double strain(const Coordinates& x);
  /// The requested penalty, with the knee raised so that no element is far beyond it.
  PenaltyOptions fitting(const Coordinates& x);
  /// The penalty far from a solution, and on a path.
  PenaltyOptions gentle();
  void lower_limits(Coordinates& x, double fraction, const RunRecorder::Enough& enough);
  /// Switches Newton's method to the energy with this penalty.
  void change_penalty(const PenaltyOptions& penalty);

  const VariationalForm& energy();

  std::shared_ptr<const VariationalForm> energy_;  // minimised by newton(); null: not made yet
  std::unique_ptr<const TargetPath> target_path_;
  std::unique_ptr<EnergyDescent> descent_;
  bool on_path_ = false;
};

}  // namespace winslow
