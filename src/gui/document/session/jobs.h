#pragma once

#include "gui/document/actions/document_actions.h"
#include "gui/document/history/edit_history.h"
#include "gui/document/jobs/run_settings.h"
#include "gui/document/session/live_mesh.h"
#include "gui/document/session/message_board.h"
#include "gui/document/session/selection.h"
#include "gui/document/session/solver_settings.h"

namespace winslow::gui {

/// Carries out commands on the open mesh, one at a time, and appends the results to its history. No
/// function waits for the solver.
class Jobs {
 public:
  Jobs(OngoingWork& work, LiveMesh& mesh, MessageBoard& messages, Selection& selection,
       SolverSettings& settings)
      : work_(work), mesh_(mesh), messages_(messages), selection_(selection), settings_(settings) {}

  /// Collects the threads' results since the last call. True if anything changed.
  bool poll();
  /// True while a thread is working.
  bool working() const;

  /// Iterations per second of the direct method; 0: no limit.
  double pace() const { return pace_; }
  /// The running command is not the user's work, see action::RunCommand::shown_only.
  bool shown_only() const { return work_.job().active() && shown_only_; }
  /// Commands that wait for the running one.
  const CommandQueue& queue() const { return queue_; }
  /// True if the running job moves exactly these markers: it can be given a new target.
  bool can_join(const std::vector<std::string>& markers) const;

  /// start: see RunOptions::start. cut_short: why the command does less than the user requested, a
  /// sentence for the banner above its result. Returns false, after telling the user why, if it
  /// cannot begin.
  bool start(Command command, bool paused, std::optional<Coordinates> start = {},
             std::string cut_short = {});
  /// Carries out a plan, command after command.
  void start(CommandQueue::Plan plan);
  /// Updates everything that refers to the mesh on screen, after the document has moved to another
  /// position of its history.
  void show_position();
  /// Ends the running command at once and restores the mesh before it.
  void stop();
  void cancel();

  void on(const action::RunSmooth&);
  void on(const action::Scramble& a) { start(ScrambleCommand{a.seed}, false); }
  void on(const action::PauseSolver&) { work_.job().pause(); }
  void on(const action::ResumeSolver&) { work_.job().resume(); }
  void on(const action::StepSolver& a);
  void on(const action::CancelSolver&) { cancel(); }
  void on(const action::SetPace& a);
  void on(const action::FollowSolver& a);
  void on(const action::RunCommand& a);
  void on(const action::RerunStep& a);

 private:
  void finish(JobRunner::Outcome outcome);
  void keep(JobRunner::Outcome outcome);
  void end_rerun();
  void run_queue(bool paused);
  void stop_queue_at(const std::string& error);
  void abandon_queue();
  double pace_of(Command command) const;
  void tell_finished(const std::string& what, const SmoothResult& smooth);

  OngoingWork& work_;
  LiveMesh& mesh_;
  MessageBoard& messages_;
  Selection& selection_;
  SolverSettings& settings_;
  double pace_ = default_pace;
  CommandQueue queue_;
  std::string cut_short_;             // see start()
  bool shown_only_ = false;           // of the running command
  std::optional<std::size_t> rerun_;  // position of the history that the job recomputes
};

}  // namespace winslow::gui
