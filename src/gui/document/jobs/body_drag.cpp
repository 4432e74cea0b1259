#include "gui/document/jobs/body_drag.h"

#include "gui/base/background.h"
#include "gui/base/text.h"

namespace winslow::gui {

void BodyDrag::begin(const MeshState& state, DragGrip grip, const SmoothOptions& options,
                     std::optional<DragSession::Start> start, const ResolveFiles& files) {
  DragFrame first;
  std::unique_ptr<DragSession> session;
  std::future<std::unique_ptr<DragSession>> reading;
  RigidMotion from = resolve_motion({}, state.mesh.coordinates.dimension(), Vec3(0, 0, 0));
  if (start) from = start->motion;
  if (options.slide.reference.empty()) {
    session =
        std::make_unique<DragSession>(state, grip, options, std::move(start), files(options.slide));
  } else {
    first = DragSession::first_frame(state, grip, options, start ? &*start : nullptr);
    reading = std::async(std::launch::async, [=, start = std::move(start)] {
      return std::make_unique<DragSession>(state, grip, options, start, files(options.slide));
    });
  }
  end();
  session_ = std::move(session);
  reading_ = std::move(reading);
  still_ = std::move(first);
  grip_ = std::move(grip);
  revision_ = 0;
  to(from);
}

void BodyDrag::to(const RigidMotion& motion) {
  wanted_ = session_ ? session_->along(motion) : motion;
  frame_ = session_ ? &session_->to(wanted_) : &still_;
  if (session_) return;
  const int dimension = still_.coordinates.dimension();
  still_.held = !same_motion(still_.motion, resolve_motion(motion, dimension, Vec3(0, 0, 0)));
  still_.share = still_.held ? 0 : 1;
}

bool BodyDrag::poll() {
  std::erase_if(ending_, [](const std::future<void>& f) {
    return f.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
  });
  if (reading_.valid() && reading_.wait_for(std::chrono::seconds(0)) == std::future_status::ready) {
    unread_ = error_of([&] { session_ = reading_.get(); });
    to(wanted_);
    return true;
  }
  if (!session_) return false;
  const int revision = session_->revision();
  if (revision == revision_) return false;
  revision_ = revision;
  to(wanted_);
  return true;
}

void BodyDrag::end() {
  frame_ = nullptr;
  unread_.clear();
  if (!session_ && !reading_.valid()) return;
  ending_.push_back(std::async(
      std::launch::async, [session = std::move(session_), reading = std::move(reading_)]() mutable {
        session.reset();
        reading = {};  // waits
      }));
}

BodyDrag::Reach BodyDrag::reach() const {
  if (!frame_->held) return Reach::there;
  // Use the frame, not the session, which may be one mesh ahead of the screen.
  return frame_->limit || !error().empty() ? Reach::limit : Reach::catching_up;
}

std::string blocked_text(const EdgePair& contact) {
  if (contact.other == contact.moving) return "Blocked by the body itself";
  return contact.other.empty() ? "Blocked by an unnamed boundary"
                               : "Blocked by \"" + contact.other + '"';
}

std::string blocked_text(const BodyDrag& drag) {
  if (!drag.error().empty()) return "The mesh cannot follow any further";
  const auto& contact = drag.frame().contact;
  return contact ? blocked_text(*contact) : "No valid mesh was found";
}

std::string updating_text(const BodyDrag& drag) {
  const auto percent = static_cast<int>(std::floor(100 * drag.frame().share));
  return "Updating mesh... " + std::to_string(percent) + " %";
}

namespace {

constexpr const char* got_to = ": the body is where it got to";

std::string share_text(double share, const char* of) {
  return short_number(100 * share) + " % of the " + of;
}

/// The worst value of each metric with a limit: " Worst elements now: Normalized Jacobian 0.512."
std::string worst_values(const QualityFloor& floor, const Mesh& mesh) {
  std::string text;
  for (std::size_t m = 0; m < floor.limits.size(); ++m) {
    if (!floor.limits[m]) continue;
    const Metric metric = limited_metrics()[m];
    const double worst = element_value(mesh, worst_element(mesh, metric), metric);
    text += (text.empty() ? " Worst elements now: " : ", ") + std::string(metric_label(metric)) +
            ' ' + short_number(worst);
  }
  return text.empty() ? text : text + '.';
}

/// Text for a motion that ended at a quality limit.
std::string end_at_limit(const MotionEnd& end) {
  const std::string& limit = end.smooth.limited_by;
  std::string text = limit;
  if (end.reached >= 1)
    text += " if it were smoothed to the end: the mesh is the last one within the limit.";
  else if (end.reached <= 0)
    text += " at once: the body has not moved.";
  else
    text += " beyond " + share_text(end.reached, "motion") + got_to + '.';
  return text + worst_values(end.floor, end.mesh);
}

}  // namespace

std::string end_of_drag(const BodyDrag& drag) {
  return blocked_text(drag) + (drag.frame().contact ? " after " : " beyond ") +
         share_text(drag.frame().share, "drag") + got_to + '.';
}

std::string end_of_motion(const MotionEnd& end) {
  const SmoothResult& smooth = end.smooth;
  if (!smooth.contact && !smooth.limited_by.empty()) return end_at_limit(end);
  std::string text = "No valid mesh was found beyond ";
  if (smooth.contact)
    text = blocked_text(smooth.contact->edges) + " after ";
  else if (smooth.out_of_iterations)
    text = "The limit of iterations was reached after ";
  text += share_text(end.reached, "motion") + got_to;
  if (smooth.gap) text += ", " + describe(*smooth.gap);
  return text + '.';
}

}  // namespace winslow::gui
