#pragma once

#include <optional>

#include "gui/document/actions/dispatch.h"
#include "gui/document/actions/document_actions.h"
#include "gui/document/session/jobs.h"
#include "gui/document/session/live_mesh.h"
#include "gui/document/session/message_board.h"
#include "gui/document/session/selection.h"

namespace winslow::gui {

/// Moves and reshapes what is selected: by numbers, or under the mouse with the mesh following.
class Motions {
 public:
  Motions(LiveMesh& mesh, MessageBoard& messages, Selection& selection, Jobs& jobs)
      : mesh_(mesh), messages_(messages), selection_(selection), jobs_(jobs) {}

  void apply(const MotionAction& action) { Dispatch::to(*this, action); }
  /// The mesh is as it was before the drag.
  void cancel_drag();

 private:
  friend class Dispatch;
  void on(const action::ApplyMotion& a);
  void on(const action::ApplyDeformation& a);
  void on(const action::SetShapeEdit& a);
  void on(const action::BeginDrag& a);
  void on(const action::DragTo& a);
  void on(const action::EndDrag&);
  void on(const action::CancelDrag&) { cancel_drag(); }

  DragGrip shape_grip() const;
  bool begin_body_drag(DragGrip grip);
  void end_body_drag();

  LiveMesh& mesh_;
  MessageBoard& messages_;
  Selection& selection_;
  Jobs& jobs_;
  std::optional<RigidMotionRequest> base_;  // motion of the job that the drag joined
  std::optional<Coordinates> start_;        // mesh that the drag took over from that job
};

}  // namespace winslow::gui
