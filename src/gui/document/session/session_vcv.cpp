#include <utility>

#include "core/error.h"
#include "gui/document/session/session.h"

namespace winslow::gui {

std::shared_ptr<const VirtualControlVolumes> Session::vcv() const {
  if (!document_) return nullptr;
  if (passing_vcv_) return passing_vcv_;
  const bool editing = job_.active() && std::holds_alternative<EditVcvCommand>(job_.command());
  return editing && edited_vcv_ ? edited_vcv_ : document_->state().vcv;
}

bool Session::exists(Index node) const {
  return document_ && node >= 0 && node < topology()->node_count();
}

void Session::on(const action::HoverNode& a) {
  // The mesh may have changed since the mouse was there.
  nodes_.hover(a.node && exists(*a.node) ? a.node : std::nullopt);
}

void Session::on(const action::SelectNode& a) {
  if (a.node && !exists(*a.node)) {
    if (document_)
      tell(Notice::Kind::warning, "The mesh has no node " + std::to_string(*a.node) +
                                      ": they count from 0 to " +
                                      std::to_string(topology()->node_count() - 1) + ".");
    return;
  }
  nodes_.inspect(a.node);
}

void Session::on(const action::PinNodes& a) {
  if (!a.pinned) return nodes_.unpin(a.nodes);
  std::vector<Index> with_vcv = a.nodes;
  std::erase_if(with_vcv, [this](Index node) {
    return !exists(node) || topology()->constrained(node) || !topology()->used(node);
  });
  nodes_.pin(with_vcv);
}

void Session::on(const action::EditVcvs& a) {
  if (!document_ || a.edits.empty()) return;
  std::shared_ptr<const VirtualControlVolumes> edited;
  try {
    edited = edit_vcvs(*document_->state().vcv, a.edits);
  } catch (const UsageError& error) {
    return report_error("This is no virtual control volume", error.what());
  }
  EditVcvCommand command{a.edits, smooth_};
  if (editing_vcv_ && job_.active()) {
    edited_vcv_ = std::move(edited);
    job_.retarget(std::move(command));
    return shape_changed();
  }
  if (!start_job(std::move(command), false)) return;
  edited_vcv_ = std::move(edited);
  editing_vcv_ = a.under_mouse;
  job_.hold(a.under_mouse);
}

void Session::on(const action::EndVcvEdit&) {
  if (!std::exchange(editing_vcv_, false)) return;
  job_.hold(false);
}

void Session::on(const action::CancelVcvEdit&) {
  if (!editing_vcv_) return;
  job_.hold(false);
  stop_job();
  tell(Notice::Kind::information, "Edit cancelled");
}

}  // namespace winslow::gui
