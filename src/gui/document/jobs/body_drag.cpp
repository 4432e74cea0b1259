#include "gui/document/jobs/body_drag.h"

#include <chrono>
#include <utility>

namespace winslow::gui {

void BodyDrag::begin(const MeshState& state, DragGrip grip, const SmoothOptions& options,
                     std::optional<DragSession::Start> start) {
  const RigidMotion from = start ? start->motion : RigidMotion{};
  auto session = std::make_unique<DragSession>(state, grip, options, std::move(start));
  end();
  session_ = std::move(session);
  grip_ = std::move(grip);
  revision_ = 0;
  to(from);
}

void BodyDrag::to(const RigidMotion& motion) {
  wanted_ = motion;
  frame_ = &session_->to(motion);
}

bool BodyDrag::poll() {
  std::erase_if(ending_, [](const std::future<void>& f) {
    return f.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
  });
  if (!session_) return false;
  const int revision = session_->revision();
  if (revision == revision_) return false;
  revision_ = revision;
  to(wanted_);
  return true;
}

void BodyDrag::end() {
  if (!session_) return;
  frame_ = nullptr;
  ending_.push_back(std::async(std::launch::async,
                               [session = std::move(session_)]() mutable { session.reset(); }));
}

BodyDrag::Reach BodyDrag::reach() const {
  if (!frame_->held) return Reach::there;
  // Of the frame, not of the session: that may be a mesh ahead of what is on screen.
  return frame_->limit || !session_->error().empty() ? Reach::limit : Reach::catching_up;
}

}  // namespace winslow::gui
