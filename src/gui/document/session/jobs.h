#pragma once

#include "gui/document/actions/document_actions.h"
#include "gui/document/history/edit_history.h"
#include "gui/document/jobs/run_settings.h"
#include "gui/document/session/live_mesh.h"
#include "gui/document/session/message_board.h"
#include "gui/document/session/selection.h"
#include "gui/document/session/solver_settings.h"

namespace winslow::gui {

/// Carries out commands on the open mesh, one at a time, and puts what they come to into its
/// history. Nothing here waits for the solver.
class Jobs {
 public:
  Jobs(OngoingWork& work, LiveMesh& mesh, MessageBoard& messages, Selection& selection,
       SolverSettings& settings)
      : work_(work), mesh_(mesh), messages_(messages), selection_(selection), settings_(settings) {}

  /// Collects what the threads have done since the last call. True if anything changed.
  bool poll();
  /// True while some thread is at work.
  bool working() const;

  /// Iterations a second of the direct method; 0: as fast as they come.
  double pace() const { return pace_; }
  /// The command under way is no work of the user's, as action::RunCommand.
  bool shown_only() const { return work_.job().active() && shown_only_; }
  /// Commands that wait for the one under way.
  const CommandQueue& queue() const { return queue_; }
  /// A job under way moves just these markers: it can be sent elsewhere.
  bool can_join(const std::vector<std::string>& markers) const;

  /// start: see RunOptions::start. cut_short: why the command is less than what the user was after,
  /// a sentence for the banner over its result. False if it cannot begin; the user is told why.
  bool start(Command command, bool paused, std::optional<Coordinates> start = {},
             std::string cut_short = {});
  /// Carries out a plan, command after command.
  void start(CommandQueue::Plan plan);
  /// The document has come to another mesh of its history: all that refers to the one on screen
  /// follows.
  void show_position();
  /// Ends what is under way at once; the mesh is as it was before.
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
  bool shown_only_ = false;           // of the command under way
  std::optional<std::size_t> rerun_;  // position of the history that the job leads to again
};

}  // namespace winslow::gui
