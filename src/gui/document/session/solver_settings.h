#pragma once

#include "gui/document/actions/document_actions.h"
#include "gui/document/jobs/reference_files.h"
#include "gui/document/selection/node_overrides.h"
#include "gui/document/session/live_mesh.h"
#include "gui/document/session/message_board.h"

namespace winslow::gui {

/// How the solver is to go about the open mesh, as the user has set it. Each command gets a copy.
class SolverSettings {
 public:
  SolverSettings(const LiveMesh& mesh, MessageBoard& messages) : mesh_(mesh), messages_(messages) {}

  const SmoothOptions& smooth_options() const { return smooth_; }
  const MotionOptions& motion_options() const { return motion_; }
  /// What single nodes were told to do, as of the mesh of the history.
  const NodeOverrides& overrides() const { return overrides_; }
  /// The file of a reference surface that is being read; empty: none.
  std::filesystem::path reading_reference() const { return reference_.pending(); }

  /// Periodic sides that the file of the open mesh names; null: it is from no file.
  const GivenPeriodicity* file_pairs() const;
  /// What options ask of files, for the open mesh.
  ResolveFiles resolver() const;

  /// For a run that moves no markers.
  SmoothOptions smooth_in_place() const { return smooth_for_motion({}); }
  /// For a motion of nodes of these markers, which neither slide nor are periodic then.
  SmoothOptions smooth_for_motion(const std::vector<std::string>& markers) const;
  MoveCommand move_command(const std::vector<std::string>& markers, RigidMotion motion) const;

  void on(const action::EditSmoothOptions& a) { a.edit.apply_to(smooth_); }
  void on(const action::EditMotionOptions& a) { a.edit.apply_to(motion_); }
  void on(const action::PairMarkers& a);
  void on(const action::OverrideNode& a);
  void on(const action::StepOverride& a);
  void on(const action::ChooseReference& a);

  /// A command begins: overrides that were undone cannot be done again.
  void forget_undone() { overrides_.forget_undone(); }
  /// What is set for one mesh means nothing for another: a region, markers that slide. A surface
  /// mesh leaves nothing set that it refuses.
  void forget_mesh();
  /// Collects what the threads have done since the last call. True if anything changed.
  bool poll();
  bool busy() const { return reference_.busy(); }

 private:
  const LiveMesh& mesh_;
  MessageBoard& messages_;
  std::shared_ptr<ReferenceFiles> references_ = std::make_shared<ReferenceFiles>();
  SmoothOptions smooth_;
  MotionOptions motion_;
  NodeOverrides overrides_;
  ReferenceChoice reference_;
};

}  // namespace winslow::gui
