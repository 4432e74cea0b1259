#include "gui/document/session/quality_watch.h"

namespace winslow::gui {

void QualityWatch::watch(const std::optional<ElementField>& field) {
  if (!mesh_.document()) return;
  const bool live = mesh_.in_motion();
  if (monitor_.wants(mesh_.shape(), field, live))
    monitor_.request(mesh_.shape(), on_screen(), field, live);
}

void QualityWatch::measure_now(const std::optional<ElementField>& field) {
  if (!mesh_.document()) return;
  monitor_.measure_now(mesh_.shape(), on_screen(), field);
}

MeshState QualityWatch::on_screen() const {
  return {{mesh_.topology(), mesh_.coordinates()}, mesh_.vcv(), mesh_.layers()};
}

}  // namespace winslow::gui
