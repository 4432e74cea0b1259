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
  VcvEditor(LiveMesh& mesh, MessageBoard& messages, Jobs& jobs)
      : mesh_(mesh), messages_(messages), jobs_(jobs) {}

  void apply(const VcvAction& action) { Dispatch::to(*this, action); }

 private:
  friend class Dispatch;
  void on(const action::EditVcvs& a);
  void on(const action::EndVcvEdit&);
  void on(const action::CancelVcvEdit&);
  void show(LiveMesh::Instead edited);

  LiveMesh& mesh_;
  MessageBoard& messages_;
  Jobs& jobs_;
};

}  // namespace winslow::gui
