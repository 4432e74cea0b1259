#pragma once

#include "core/job/solver_thread.h"
#include "gui/document/jobs/reference_files.h"

namespace winslow::gui {

/// Runs one command at a time, for the frame loop: starts it, retargets it while a body is dragged,
/// and collects its result. No function waits for the solver.
class JobRunner {
 public:
  struct Outcome {
    Command command;
    std::optional<CommandResult> result;  ///< none: it failed
    std::string error;
    double seconds = 0;   ///< from its start, pauses included
    bool paused = false;  ///< the user was stepping through it
  };

  bool active() const { return active_; }
  /// A drag keeps the job running even after convergence.
  bool held() const { return held_; }
  /// Paused, or about to be.
  bool paused() const;
  const Command& command() const { return command_; }
  const MeshState& base() const { return *base_; }
  /// Latest snapshot of this job; null before the first one and without a job.
  const std::shared_ptr<const Snapshot>& snapshot() const { return snapshot_; }

  /// start: see RunOptions::start. files: resolves the files of this job and its targets, on the
  /// solver's thread.
  void run(MeshState base, Command command, bool paused, std::optional<Coordinates> start = {},
           ResolveFiles files = no_files);
  /// The job's present coordinates: of its latest snapshot, or before that its start.
  const Coordinates& coordinates() const;
  /// The immutable mesh of the latest snapshot; null before the first one.
  std::shared_ptr<const Mesh> snapshot_mesh() const {
    return snapshot_ ? snapshot_->mesh : nullptr;
  }
  /// Topology of coordinates(): a running command may change it.
  const std::shared_ptr<const Topology>& topology() const;
  bool started_elsewhere() const { return start_.has_value(); }
  void retarget(Command command);
  /// The solver has reached the present target with a valid, converged mesh.
  bool converged() const;
  /// Replaces the command by an equivalent one without notifying the solver.
  void rename(Command command) { command_ = std::move(command); }
  void hold(bool held) { held_ = held; }
  void pause();
  void resume();
  void step(int count);
  /// See SolverThread::set_pace.
  void set_pace(double iterations_per_second);
  /// on: the solver waits after every iteration until the next call, so that none is missed.
  void wait_for_viewer(bool on);
  /// Ends the job at once, with no outcome.
  void cancel();

  /// True if there is a new snapshot.
  bool poll();
  /// The outcome of a finished job, once. Ends the job.
  std::optional<Outcome> take_outcome();

 private:
  bool meets_target(const Snapshot& snapshot) const;

  SolverThread solver_;
  bool active_ = false;
  bool held_ = false;
  bool pause_requested_ = false;
  double pace_ = 0;
  std::chrono::steady_clock::time_point started_;
  std::shared_ptr<const MeshState> base_ = std::make_shared<const MeshState>();
  Command command_;
  std::uint64_t job_ = 0;
  std::shared_ptr<const Snapshot> snapshot_;
  std::optional<Coordinates> start_;  // shown until the first snapshot
};

/// Changes the outcome's command to the part that was reached if the path could not be followed to
/// its end. Otherwise replaying the history as a recipe would not give this mesh. base: the mesh at
/// the start of the job. started_elsewhere: see JobRunner. Returns the share of the path that was
/// reached; 1: all of it.
double settle_command(JobRunner::Outcome& outcome, const Mesh& base, bool started_elsewhere);

}  // namespace winslow::gui
