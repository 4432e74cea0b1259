#pragma once

#include "gui/document/actions/document_actions.h"
#include "gui/document/jobs/reference_files.h"
#include "gui/document/selection/node_overrides.h"
#include "gui/document/session/live_mesh.h"
#include "gui/document/session/message_board.h"

namespace winslow::gui {

/// The user's settings of the solver for the open mesh. Each command gets a copy.
class SolverSettings {
 public:
  SolverSettings(const LiveMesh& mesh, MessageBoard& messages) : mesh_(mesh), messages_(messages) {}

  const SmoothOptions& smooth_options() const { return smooth_; }
  const MotionOptions& motion_options() const { return motion_; }
  /// Overrides of single nodes, for the mesh of the history.
  const NodeOverrides& overrides() const { return overrides_; }
  /// The file of a reference surface that is being read; empty: none.
  std::filesystem::path reading_reference() const { return reference_.pending(); }

  /// Periodic sides named in the file of the open mesh; null: it has no file.
  const GivenPeriodicity* file_pairs() const;
  /// Resolves the files named by options, for the open mesh.
  ResolveFiles resolver() const;

  /// Options for a run that moves no markers.
  SmoothOptions smooth_in_place() const { return smooth_for_motion({}); }
  /// Options for a motion of these markers, which then neither slide nor are periodic.
  SmoothOptions smooth_for_motion(const std::vector<std::string>& markers) const;
  MoveCommand move_command(const std::vector<std::string>& markers, RigidMotion motion) const;
  /// A command for bodies that move together, each by its own motion.
  MoveCommand move_together(std::vector<MovingBody> bodies) const;

  void on(const action::EditSmoothOptions& a) { a.edit.apply_to(smooth_); }
  void on(const action::EditMotionOptions& a) { a.edit.apply_to(motion_); }
  void on(const action::PairMarkers& a);
  void on(const action::OverrideNode& a);
  void on(const action::StepOverride& a);
  void on(const action::ChooseReference& a);

  /// Called when a command begins: undone overrides can no longer be redone.
  void forget_undone() { overrides_.forget_undone(); }
  /// Clears settings that are valid for one mesh only: a region, sliding markers. For a surface
  /// mesh also resets options that it does not support.
  void forget_mesh();
  /// Collects the threads' results since the last call. True if anything changed.
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
