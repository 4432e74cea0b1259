#pragma once

#include "gui/base/background.h"
#include "gui/document/actions/document_actions.h"
#include "gui/document/session/jobs.h"
#include "gui/document/session/live_mesh.h"
#include "gui/document/session/message_board.h"
#include "gui/document/session/selection.h"

namespace winslow::gui {

/// Moves and deforms the selected bodies: by numbers, or by a drag that the mesh follows.
class Motions {
 public:
  Motions(OngoingWork& work, LiveMesh& mesh, MessageBoard& messages, Selection& selection,
          const SolverSettings& settings, Jobs& jobs)
      : work_(work),
        mesh_(mesh),
        messages_(messages),
        selection_(selection),
        settings_(settings),
        jobs_(jobs) {}

  /// Cancels the drag and restores the mesh before it.
  void cancel_drag();

  /// Carries out what a file says that has been read since the last call. True if there was one.
  bool poll();
  /// A file of single nodes is being read.
  bool busy() const { return reader_.busy(); }

  void on(const action::ApplyMotion& a);
  void on(const action::ApplyDeformation& a);
  void on(const action::ApplyBodyPlan&);
  void on(const action::MoveNodesOfFile& a);
  void on(const action::SetShapeEdit& a);
  void on(const action::BeginDrag& a);
  void on(const action::DragTo& a);
  void on(const action::EndDrag&);
  void on(const action::CancelDrag&) { cancel_drag(); }

 private:
  RigidMotion resolved(const RigidMotion& motion) const;
  /// A command for the selected bodies.
  MoveCommand move_command(const RigidMotion& motion) const {
    return settings_.move_command(selection_.names(), motion);
  }
  DragGrip shape_grip() const;
  bool begin_body_drag(DragGrip grip);
  void end_body_drag();
  void move_nodes(const decltype(DeformCommand::shape)& table);

  struct ReadTable {
    std::string name;  ///< of the file
    decltype(DeformCommand::shape) shape;
    std::string error;  ///< empty: none
  };

  OngoingWork& work_;
  LiveMesh& mesh_;
  MessageBoard& messages_;
  Selection& selection_;
  const SolverSettings& settings_;
  Jobs& jobs_;
  std::optional<RigidMotion> base_;   // motion of the job that the drag joined
  std::optional<Coordinates> start_;  // mesh that the drag took over from that job
  Background<ReadTable> reader_;
};

/// Changes virtual control volumes: at once, or by a drag that the mesh follows.
class VcvEditor {
 public:
  VcvEditor(OngoingWork& work, LiveMesh& mesh, MessageBoard& messages,
            const SolverSettings& settings, Jobs& jobs)
      : work_(work), mesh_(mesh), messages_(messages), settings_(settings), jobs_(jobs) {}

  void on(const action::EditVcvs& a);
  void on(const action::EndVcvEdit&);
  void on(const action::CancelVcvEdit&);

 private:
  OngoingWork& work_;
  LiveMesh& mesh_;
  MessageBoard& messages_;
  const SolverSettings& settings_;
  Jobs& jobs_;
};

}  // namespace winslow::gui
