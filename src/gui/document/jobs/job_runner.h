#pragma once

#include "core/job/solver_thread.h"
#include "gui/document/jobs/reference_files.h"

namespace winslow::gui {

/// The one command that is being carried out, seen from the frame loop: started, retargeted while a
/// body is dragged, and collected when it is done. Nothing here waits for the solver.
class JobRunner {
 public:
  struct Outcome {
    Command command;
    std::optional<CommandResult> result;  ///< none: it failed
    std::string error;
    double seconds = 0;   ///< from its start, pauses included
    bool paused = false;  ///< the user had it wait after some steps
  };

  bool active() const { return active_; }
  /// A drag holds the job: it may converge, but does not end.
  bool held() const { return held_; }
  /// Paused, or about to be.
  bool paused() const;
  const Command& command() const { return command_; }
  const MeshState& base() const { return *base_; }
  /// Latest snapshot of this job; null before the first and without a job.
  const std::shared_ptr<const Snapshot>& snapshot() const { return snapshot_; }

  /// start: see RunOptions::start. files: of this job and its targets, on the solver's thread.
  void run(MeshState base, Command command, bool paused, std::optional<Coordinates> start = {},
           ResolveFiles files = no_files);
  /// The mesh of this job now: of its latest snapshot, or what it starts from.
  const Coordinates& coordinates() const;
  /// The same of its latest snapshot, which stays as it is; null before the first.
  std::shared_ptr<const Mesh> snapshot_mesh() const {
    return snapshot_ ? snapshot_->mesh : nullptr;
  }
  /// That coordinates() are of: the command may change it on its way.
  const std::shared_ptr<const Topology>& topology() const;
  bool started_elsewhere() const { return start_.has_value(); }
  void retarget(Command command);
  /// The solver has reached the present target with a valid, converged mesh.
  bool converged() const;
  /// Another way to say the present target: the solver is not told.
  void rename(Command command) { command_ = std::move(command); }
  void hold(bool held) { held_ = held; }
  void pause();
  void resume();
  void step(int count);
  /// See SolverThread::set_pace.
  void set_pace(double iterations_per_second);
  /// On: the solver waits after every iteration until this is called again, so that none is missed.
  void wait_for_viewer(bool on);
  /// Ends the job at once, with no outcome.
  void cancel();

  /// True if there is a new snapshot.
  bool poll();
  /// What the job came to, once. Ends the job.
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

/// A path that could not be followed to its end leaves the boundary where it got to. The history
/// must say that, not what was asked for: a recipe replayed gives this mesh. Changes the outcome's
/// command accordingly.
/// base: the mesh that the job began with. started_elsewhere: see JobRunner. Returns the share of
/// the way that was reached; 1: all of it.
double settle_command(JobRunner::Outcome& outcome, const Mesh& base, bool started_elsewhere);

}  // namespace winslow::gui
