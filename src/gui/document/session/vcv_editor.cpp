#include "gui/document/session/vcv_editor.h"

#include "core/error.h"
#include "core/mesh/topology.h"
#include "core/vcv/sphere/node_vcv.h"

namespace winslow::gui {

void VcvEditor::on(const action::EditVcvs& a) {
  if (!mesh_.document() || a.edits.empty()) return;
  const MeshState& state = mesh_.document()->state();
  OngoingWork::EditedVcvs edited;
  try {
    if (kind_of(*state.mesh.topology) == MeshKind::volume)
      edited.sphere = edit_vcvs(*state.mesh.topology, state.vcvs.by_hand().get(), a.edits);
    else
      edited.plane = edit_vcvs(*state.vcvs.plane(), a.edits);
  } catch (const UsageError& error) {
    return messages_.report_error("This is no virtual control volume", error.what());
  }
  EditVcvCommand command{a.edits, settings_.smooth_in_place()};
  if (work_.held().vcv && work_.job().active()) {
    work_.set_edited_vcvs(std::move(edited));
    work_.job().retarget(std::move(command));
    return mesh_.changed();
  }
  if (!jobs_.start(std::move(command), false)) return;
  work_.set_edited_vcvs(std::move(edited));
  work_.held().vcv = a.under_mouse;
  work_.job().hold(a.under_mouse);
}

void VcvEditor::on(const action::EndVcvEdit&) {
  if (!std::exchange(work_.held().vcv, false)) return;
  work_.job().hold(false);
}

void VcvEditor::on(const action::CancelVcvEdit&) {
  if (!work_.held().vcv) return;
  work_.job().hold(false);
  jobs_.stop();
  messages_.tell(Notice::Kind::information, "Edit cancelled");
}

}  // namespace winslow::gui
