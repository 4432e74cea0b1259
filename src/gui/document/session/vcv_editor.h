#pragma once

#include "gui/document/actions/dispatch.h"
#include "gui/document/actions/document_actions.h"
#include "gui/document/session/jobs.h"
#include "gui/document/session/live_mesh.h"
#include "gui/document/session/message_board.h"

namespace winslow::gui {

/// Changes virtual control volumes: at once, or under the mouse with the mesh following.
class VcvEditor {
 public:
  VcvEditor(OngoingWork& work, LiveMesh& mesh, MessageBoard& messages,
            const SolverSettings& settings, Jobs& jobs)
      : work_(work), mesh_(mesh), messages_(messages), settings_(settings), jobs_(jobs) {}

  void apply(const VcvAction& action) { Dispatch::to(*this, action); }

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
