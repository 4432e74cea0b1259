#pragma once

#include "core/command/command.h"

/// A command beside a user interface:
///
///     winslow::SolverThread solver;
///     solver.run(state, command);
///     while (solver.busy()) {
///       const auto snapshot = solver.latest();  // never null; draw snapshot->mesh
///       std::this_thread::sleep_for(std::chrono::milliseconds(16));
///     }
///     const auto last = solver.latest();
///     if (last->state == winslow::JobState::done) state = last->result->state;
namespace winslow {

enum class JobState { idle, running, paused, done, cancelled, failed };

/// A consistent picture of a job at one moment. Immutable once published.
struct Snapshot {
  std::uint64_t serial = 0;  ///< grows with every snapshot of one SolverThread
  std::uint64_t job = 0;     ///< which call of run() it belongs to
  JobState state = JobState::idle;
  std::shared_ptr<const Mesh> mesh;      ///< after the last finished outer iteration; null: idle
  std::vector<IterationRecord> history;  ///< of this job so far
  std::optional<Command> command;        ///< as last targeted
  std::optional<CommandResult> result;   ///< with state done
  std::string error;                     ///< with state failed: what to tell the user
};

/// Runs commands on a thread of its own. Every member returns at once (none waits for an
/// iteration), except the destructor, which cancels and joins. Members are called from one thread.
class SolverThread {
 public:
  SolverThread();
  ~SolverThread();
  SolverThread(const SolverThread&) = delete;
  SolverThread& operator=(const SolverThread&) = delete;

  /// Starts a command on a state; one that is under way is cancelled first. `start`: interior to
  /// start from (see RunOptions::start). paused: stop before the first iteration. Returns the
  /// job's number.
  std::uint64_t run(std::shared_ptr<const MeshState> state, Command command,
                    std::optional<Coordinates> start = {}, bool paused = false);
  std::uint64_t run(MeshState state, Command command, std::optional<Coordinates> start = {},
                    bool paused = false) {
    return run(std::make_shared<const MeshState>(std::move(state)), std::move(command),
               std::move(start), paused);
  }
  /// Replaces the command of the job under way, on the same state, and goes on from the interior
  /// reached so far: for dragging. Starts again from there if the job had ended.
  void retarget(Command command);
  void pause();
  void resume();
  /// Runs n more outer iterations, then pauses.
  void step(int n);
  void cancel();
  /// At most this many outer iterations a second, for someone who watches; 0: as fast as they come.
  /// Holds for all jobs until it is set again. Pause, step and cancel act at once all the same.
  void set_pace(double iterations_per_second);
  /// For a viewer who is to miss no iteration. seen: serial of the last snapshot that the viewer
  /// has seen; the worker waits until that is the latest one. None, as at first: it does not wait.
  /// Pause, step, cancel and another target act at once all the same.
  void wait_for_viewer(std::optional<std::uint64_t> seen);
  /// Reads what commands ask of files, on the solver's thread, before each is carried out; what it
  /// throws ends the job. It holds for the jobs that begin from then on. None, as at first:
  /// commands that ask for files are refused.
  using Resolve = std::function<ResolvedCommand(const Command&)>;
  void resolve(Resolve with);
  /// True while a job is running or paused.
  bool busy() const;

  /// Latest snapshot; never null.
  std::shared_ptr<const Snapshot> latest() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace winslow
