#include "gui/document/jobs/body_drag.h"

#include <chrono>
#include <cmath>

#include "core/motion/rigid_motion.h"
#include "gui/base/text.h"

namespace winslow::gui {

namespace {

/// The motion that a request says, which names its pivot.
template <int D>
RigidMotionIn<D> named_motion(const RigidMotionRequest& request) {
  if constexpr (D == 2)
    return request.about(Vec2(0, 0));
  else
    return request.in_space(Vec3(0, 0, 0));
}

}  // namespace

template <int D>
class BodyDrag::SessionIn final : public Session {
 public:
  using Core = DragSessionIn<D>;

  SessionIn(const MeshState& state, DragGrip grip, const SmoothOptions& options,
            std::optional<Start> start, const std::shared_ptr<ReferenceFiles>& files)
      : core_(state, std::move(grip), options, core_start(std::move(start)),
              [files](const std::string& name) { return files->read(name); }) {}

  Frame to(const RigidMotionRequest& motion) override {
    shown_ = &core_.to(named_motion<D>(motion));
    return {shown_->motion, shown_->held,     shown_->limit,
            shown_->share,  shown_->min_sine, shown_->contact};
  }
  const Coordinates& coordinates() const override { return shown_->coordinates; }
  int revision() const override { return core_.revision(); }
  bool settled() const override { return core_.settled(); }
  std::string error() const override { return core_.error(); }

 private:
  static std::optional<typename Core::Start> core_start(std::optional<Start> start) {
    if (!start) return std::nullopt;
    return typename Core::Start{std::move(start->coordinates), named_motion<D>(start->motion)};
  }

  Core core_;
  const DragFrameIn<D>* shown_ = nullptr;
};

void BodyDrag::begin(const MeshState& state, DragGrip grip, const SmoothOptions& options,
                     std::optional<Start> start) {
  const bool in_space = state.mesh.coordinates.dimension() == 3;
  RigidMotionRequest from = in_space ? RigidMotionRequest(SpaceMotion()) : RigidMotion();
  if (start) from = start->motion;
  std::unique_ptr<Session> session;
  if (in_space)
    session = std::make_unique<SessionIn<3>>(state, grip, options, std::move(start), references_);
  else
    session = std::make_unique<SessionIn<2>>(state, grip, options, std::move(start), references_);
  end();
  session_ = std::move(session);
  grip_ = std::move(grip);
  revision_ = 0;
  to(from);
}

void BodyDrag::to(const RigidMotionRequest& motion) {
  wanted_ = motion;
  frame_ = session_->to(motion);
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
  ending_.push_back(std::async(std::launch::async,
                               [session = std::move(session_)]() mutable { session.reset(); }));
}

BodyDrag::Reach BodyDrag::reach() const {
  if (!frame_.held) return Reach::there;
  // Of the frame, not of the session: that may be a mesh ahead of what is on screen.
  return frame_.limit || !session_->error().empty() ? Reach::limit : Reach::catching_up;
}

RigidMotionRequest compose(const RigidMotionRequest& first, const RigidMotionRequest& second,
                           bool in_space) {
  if (in_space) return compose(named_motion<3>(first), named_motion<3>(second));
  return compose(named_motion<2>(first), named_motion<2>(second));
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

/// What each metric with a limit has come to: " Worst elements now: Normalized Jacobian 0.512."
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

/// The motion ended before a limit of the quality.
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
