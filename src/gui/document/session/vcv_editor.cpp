#include "gui/document/session/vcv_editor.h"

#include <memory>
#include <utility>

#include "core/error.h"
#include "core/mesh/topology.h"
#include "core/vcv/sphere/node_vcv.h"

namespace winslow::gui {

void VcvEditor::on(const action::EditVcvs& a) {
  if (!mesh_.document() || a.edits.empty()) return;
  const MeshState& state = mesh_.document()->state();
  LiveMesh::Instead edited;
  try {
    if (kind_of(*state.mesh.topology) == MeshKind::volume)
      edited.sphere_vcvs = edit_vcvs(*state.mesh.topology, state.sphere_vcvs.get(), a.edits);
    else
      edited.vcv = edit_vcvs(*state.vcv, a.edits);
  } catch (const UsageError& error) {
    return messages_.report_error("This is no virtual control volume", error.what());
  }
  EditVcvCommand command{a.edits, jobs_.smooth_in_place()};
  if (mesh_.held().vcv && mesh_.job().active()) {
    show(std::move(edited));
    mesh_.job().retarget(std::move(command));
    return mesh_.changed();
  }
  if (!jobs_.start(std::move(command), false)) return;
  show(std::move(edited));
  mesh_.held().vcv = a.under_mouse;
  mesh_.job().hold(a.under_mouse);
}

void VcvEditor::show(LiveMesh::Instead edited) {
  mesh_.instead().vcv = std::move(edited.vcv);
  mesh_.instead().sphere_vcvs = std::move(edited.sphere_vcvs);
}

void VcvEditor::on(const action::EndVcvEdit&) {
  if (!std::exchange(mesh_.held().vcv, false)) return;
  mesh_.job().hold(false);
}

void VcvEditor::on(const action::CancelVcvEdit&) {
  if (!mesh_.held().vcv) return;
  mesh_.job().hold(false);
  jobs_.stop();
  messages_.tell(Notice::Kind::information, "Edit cancelled");
}

}  // namespace winslow::gui
