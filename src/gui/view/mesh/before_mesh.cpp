#include "gui/view/mesh/before_mesh.h"

#include "gui/document/session/before_state.h"

namespace winslow::gui {

void BeforeMesh::update(const Session& session, const ViewOptions& view) {
  document_ = session.document();
  if (!document_) {
    coordinates_ = nullptr;
    topology_.reset();
    return;
  }
  if (generation_ != session.generation()) {
    generation_ = session.generation();
    monitor_.clear();
    key_ = nullptr;
  }
  const std::size_t position = position_before(session.mesh(), view.before);
  const MeshState& state = document_->history().state(position);
  const Coordinates& now = state.mesh.coordinates;
  loaded_ = position == 0;
  // The history moves its steps about, but not the numbers that they hold.
  const void* key = now.values().data();
  if (key != key_) ++shape_;
  key_ = key;
  coordinates_ = &now;
  topology_ = state.mesh.topology;
  const bool values = view.comparison == Comparison::split && view.color;
  if (loaded_ && !values) return;
  // Compared with itself: nothing has changed yet.
  const QualityMonitor::Wish wish{values ? view.color : std::nullopt, &now, document_->given()};
  if (!monitor_.wants(shape_, wish, false)) return;
  monitor_.request(
      shape_, {std::make_shared<const Mesh>(state.mesh), state.vcv, state.layers, state.surface},
      wish, false);
}

const QualityReport* BeforeMesh::report() const {
  if (!document_) return nullptr;
  if (loaded_) return &document_->loaded_quality();
  const auto& latest = monitor_.latest();
  return latest && latest->shape == shape_ ? &latest->report : nullptr;
}

std::shared_ptr<const QualityMonitor::Measured> BeforeMesh::measured() const {
  const auto& latest = monitor_.latest();
  return latest && latest->shape == shape_ ? latest : nullptr;
}

}  // namespace winslow::gui
