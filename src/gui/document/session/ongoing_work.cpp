#include "gui/document/session/ongoing_work.h"

namespace winslow::gui {

void OngoingWork::begin_drag(MeshState base, DragGrip grip, const SmoothOptions& options,
                             std::optional<DragSession::Start> start, const ResolveFiles& files) {
  drag_.begin(base, std::move(grip), options, std::move(start), files);
  drag_base_ = std::move(base);
}

const Coordinates* OngoingWork::coordinates() const {
  if (drag_.active()) return &drag_.coordinates();
  return job_.active() ? &job_.coordinates() : nullptr;
}

const std::shared_ptr<const Topology>* OngoingWork::topology() const {
  if (drag_.active()) return &drag_base_.mesh.topology;
  return job_.active() ? &job_.topology() : nullptr;
}

const MeshState* OngoingWork::base() const {
  if (drag_.active()) return &drag_base_;
  return job_.active() ? &job_.base() : nullptr;
}

const OngoingWork::EditedVcvs* OngoingWork::edited_vcvs() const {
  const bool editing = job_.active() && std::holds_alternative<EditVcvCommand>(job_.command());
  return editing ? &edited_ : nullptr;
}

}  // namespace winslow::gui
