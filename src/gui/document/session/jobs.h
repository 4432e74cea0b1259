#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "gui/document/actions/dispatch.h"
#include "gui/document/actions/document_actions.h"
#include "gui/document/history/edit_history.h"
#include "gui/document/jobs/reference_files.h"
#include "gui/document/jobs/run_settings.h"
#include "gui/document/jobs/wall_layers.h"
#include "gui/document/selection/node_overrides.h"
#include "gui/document/session/live_mesh.h"
#include "gui/document/session/message_board.h"
#include "gui/document/session/selection.h"

namespace winslow::gui {

/// Carries out commands on the open mesh, one at a time, and puts what they come to into its
/// history. Nothing here waits for the solver.
class Jobs {
 public:
  Jobs(LiveMesh& mesh, MessageBoard& messages, Selection& selection)
      : mesh_(mesh), messages_(messages), selection_(selection) {}

  void apply(const JobAction& action) { Dispatch::to(*this, action); }
  /// Collects what the threads have done since the last call. True if anything changed.
  bool poll();
  /// True while some thread is at work.
  bool working() const;

  const SmoothOptions& smooth_options() const { return smooth_; }
  const MotionOptions& motion_options() const { return motion_; }
  /// What single nodes were told to do, as of the mesh of the history.
  const NodeOverrides& overrides() const { return overrides_; }
  /// Iterations a second of the direct method; 0: as fast as they come.
  double pace() const { return pace_; }
  /// The file of a reference surface that is being read; empty: none.
  std::filesystem::path reading_reference() const { return reference_.pending(); }
  /// The command under way is no work of the user's, as action::RunCommand.
  bool shown_only() const { return mesh_.job().active() && shown_only_; }
  /// Commands that wait for the one under way.
  const CommandQueue& queue() const { return queue_; }
  /// Layers that are planned for the mesh of the history.
  const LayerPreview& layer_preview() const { return layer_preview_; }
  LayerPreview& layer_preview() { return layer_preview_; }
  /// Layers that came with the mesh of the history.
  const FoundLayers& found_layers() const { return found_layers_; }

  /// start: see RunOptions::start. cut_short: why the command is less than what the user was after,
  /// a sentence for the banner over its result. False if it cannot begin; the user is told why.
  bool start(Command command, bool paused, std::optional<Coordinates> start = {},
             std::string cut_short = {});
  /// Carries out a plan, command after command.
  void start(CommandQueue::Plan plan);
  /// Ends what is under way at once; the mesh is as it was before.
  void stop();
  void cancel();
  /// The solver's settings for a run that moves no markers.
  SmoothOptions smooth_in_place() const { return smooth_for_motion({}); }
  /// The solver's settings for a motion of nodes of these markers, which neither slide nor
  /// are periodic then.
  SmoothOptions smooth_for_motion(const std::vector<std::string>& markers) const;
  /// Moves selected bodies.
  MoveCommand move_command(const RigidMotionRequest& motion) const;
  /// A job under way moves just these markers: it can be sent elsewhere.
  bool can_join(const std::vector<std::string>& markers) const;
  /// What is set for one mesh means nothing for another: a region, markers that slide. A surface
  /// mesh leaves nothing set that it refuses.
  void forget_mesh();
  /// The document has come to another mesh: all that refers to the one on screen follows.
  void show_position();

 private:
  friend class Dispatch;
  void on(const action::RunSmooth&);
  void on(const action::Scramble& a) { start(ScrambleCommand{a.seed}, false); }
  void on(const action::PauseSolver&) { mesh_.job().pause(); }
  void on(const action::ResumeSolver&) { mesh_.job().resume(); }
  void on(const action::StepSolver& a);
  void on(const action::CancelSolver&) { cancel(); }
  void on(const action::EditSmoothOptions& a) { a.edit.apply_to(smooth_); }
  void on(const action::EditMotionOptions& a) { a.edit.apply_to(motion_); }
  void on(const action::PairMarkers& a);
  void on(const action::OverrideNode& a);
  void on(const action::StepOverride& a);
  void on(const action::ChooseReference& a);
  void on(const action::SetPace& a);
  void on(const action::FollowSolver& a);
  void on(const action::RunCommand& a);
  void on(const action::RerunStep& a);
  void on(const action::PreviewLayers& a) { layer_preview_.want(a.options); }

  void finish(JobRunner::Outcome outcome);
  void keep(JobRunner::Outcome outcome);
  void end_rerun();
  void run_queue(bool paused);
  void stop_queue_at(const std::string& error);
  void abandon_queue();
  bool poll_reference();
  std::string cancelled_text() const;
  double pace_of(Command command) const;
  void tell_finished(const std::string& what, const SmoothResult& smooth);

  LiveMesh& mesh_;
  MessageBoard& messages_;
  Selection& selection_;
  SmoothOptions smooth_;
  MotionOptions motion_;
  NodeOverrides overrides_;
  double pace_ = default_pace;
  CommandQueue queue_;
  LayerPreview layer_preview_;
  FoundLayers found_layers_;
  ReferenceChoice reference_;
  std::string cut_short_;             // see start()
  bool shown_only_ = false;           // of the command under way
  std::optional<std::size_t> rerun_;  // position of the history that the job leads to again
};

}  // namespace winslow::gui
