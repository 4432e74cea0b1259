#include "gui/document/session/quality_watch.h"

namespace winslow::gui {

namespace {

/// It was left out while a solver was at work, and is not yet made up for.
bool lacks_deviation(const LiveMesh& mesh, const QualityMonitor::Measured& measured) {
  return mesh.document()->given() && !mesh.in_motion() && !measured.deviation;
}

}  // namespace

void QualityWatch::watch(const std::optional<ElementField>& field, BeforeState before) {
  if (!mesh_.document()) return;
  // While it is paused there is time for all of it.
  const bool live = mesh_.in_motion() && !mesh_.job().paused();
  const QualityMonitor::Wish wanted = wish(field, before);
  if (monitor_.wants(mesh_.shape(), wanted, live))
    monitor_.request(mesh_.shape(), on_screen(), wanted, live);
}

void QualityWatch::measure_now(const std::optional<ElementField>& field, BeforeState before) {
  if (!mesh_.document()) return;
  monitor_.measure_now(mesh_.shape(), on_screen(), wish(field, before));
}

bool QualityWatch::up_to_date(const std::optional<ElementField>& field, BeforeState before) const {
  const auto& measured = monitor_.latest();
  return measured && mesh_.document() && measured->shape == mesh_.shape() &&
         wish(field, before).met_by(*measured) && !lacks_deviation(mesh_, *measured);
}

QualityMonitor::Wish QualityWatch::wish(const std::optional<ElementField>& field,
                                        BeforeState before) const {
  const MeshState& state = mesh_.document()->history().state(position_before(mesh_, before));
  // Nodes of another connectivity are no earlier places of these.
  return {field, state.mesh.topology == mesh_.topology() ? &state.mesh.coordinates : nullptr,
          mesh_.document()->given()};
}

QualityMonitor::Subject QualityWatch::on_screen() const {
  return {shared_mesh(mesh_), mesh_.vcv(), mesh_.layers(), mesh_.document()->state().surface};
}

std::size_t position_before(const LiveMesh& mesh, BeforeState which) {
  const History& history = mesh.document()->history();
  if (which == BeforeState::loaded) return 0;
  // While a command is being carried out, its own start; else that of the last one.
  if (mesh.in_motion()) return history.position();
  return history.position() > 0 ? history.position() - 1 : 0;
}

}  // namespace winslow::gui
