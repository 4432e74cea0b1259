#pragma once

#include "core/command/command.h"

/// Runs a command in the background of a user interface:
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

/// Runs commands on its own thread. Every member returns at once (none waits for an iteration),
/// except the destructor, which cancels and joins. Call the members from one thread.
class SolverThread {
 public:
  SolverThread();
  ~SolverThread();
  SolverThread(const SolverThread&) = delete;
  SolverThread& operator=(const SolverThread&) = delete;

  /// Starts a command on a state; a running job is cancelled first. `start`: interior to start from
  /// (see RunOptions::start). paused: stop before the first iteration. Returns the job's number.
  std::uint64_t run(std::shared_ptr<const MeshState> state, Command command,
                    std::optional<Coordinates> start = {}, bool paused = false);
  std::uint64_t run(MeshState state, Command command, std::optional<Coordinates> start = {},
                    bool paused = false) {
    return run(std::make_shared<const MeshState>(std::move(state)), std::move(command),
               std::move(start), paused);
  }
  /// Replaces the command of the current job, on the same state, and continues from the interior
  /// reached so far: for dragging. If the job has ended, starts it again from there.
  void retarget(Command command);
  void pause();
  void resume();
  /// Runs n more outer iterations, then pauses.
  void step(int n);
  void cancel();
  /// Limits the outer iterations per second, for display; 0: no limit. Applies to all jobs until
  /// set again. Pause, step and cancel still act at once.
  void set_pace(double iterations_per_second);
  /// For a viewer that shows every iteration. seen: serial of the last snapshot that the viewer has
  /// shown; the worker waits until this is the latest one. None (default): the worker does not
  /// wait. Pause, step, cancel and retarget() still act at once.
  void wait_for_viewer(std::optional<std::uint64_t> seen);
  /// Sets the function that reads the files of a command. The solver's thread calls it before each
  /// command; an exception from it ends the job. Applies to jobs that begin afterwards. None
  /// (default): commands that refer to files are refused.
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
