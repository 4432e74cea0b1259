#include "gui/document/session/body_plan.h"

#include "core/error.h"
#include "core/motion/rigid_motion.h"
#include "gui/document/session/selection.h"

namespace winslow::gui {

namespace {

/// True for a motion of the same bodies, whatever the motions.
bool moves_these(const Command& command, const std::vector<MovingBody>& bodies) {
  const auto* move = std::get_if<MoveCommand>(&command);
  return move &&
         std::ranges::equal(move->bodies, bodies, {}, &MovingBody::markers, &MovingBody::markers);
}

}  // namespace

const RigidMotion* BodyPlan::find(const std::vector<std::string>& markers) const {
  const auto body = std::ranges::find(bodies_, markers, &MovingBody::markers);
  return body == bodies_.end() ? nullptr : &body->motion;
}

bool BodyPlan::contains(const std::string& marker) const {
  return std::ranges::any_of(bodies_, [&](const MovingBody& body) {
    return std::ranges::find(body.markers, marker) != body.markers.end();
  });
}

bool BodyPlan::moves() const {
  return std::ranges::any_of(bodies_,
                             [](const MovingBody& body) { return winslow::moves(body.motion); });
}

void BodyPlan::put(MovingBody body) {
  if (body.markers.empty()) return;
  ++revision_;
  begun_ = false;
  const auto same = std::ranges::find(bodies_, body.markers, &MovingBody::markers);
  if (same != bodies_.end()) {
    same->motion = body.motion;
    return;
  }
  for (MovingBody& other : bodies_)
    std::erase_if(other.markers, [&](const std::string& name) {
      return std::ranges::find(body.markers, name) != body.markers.end();
    });
  std::erase_if(bodies_, [](const MovingBody& other) { return other.markers.empty(); });
  bodies_.push_back(std::move(body));
}

void BodyPlan::remove(std::size_t number) {
  if (number >= bodies_.size()) return;
  if (bodies_.size() == 1) return clear();
  ++revision_;
  begun_ = false;
  bodies_.erase(bodies_.begin() + static_cast<std::ptrdiff_t>(number));
}

void BodyPlan::clear() {
  ++revision_;
  begun_ = false;
  bodies_.clear();
  done_.clear();
}

void BodyPlan::moved(const MoveCommand& move) {
  ++revision_;
  if (std::exchange(begun_, false) && moves_these(move, bodies_)) {
    done_ = std::exchange(bodies_, {});
    done_at_ = mesh_.document()->history().position() + 1;
    return;
  }
  const int dimension = mesh_.coordinates().dimension();
  for (const MovingBody& body : move.bodies) {
    const RigidMotion motion = resolve_motion(body.motion, dimension, Vec3(0, 0, 0));
    for (MovingBody& listed : bodies_) {
      const bool goes = std::ranges::all_of(listed.markers, [&](const std::string& name) {
        return std::ranges::find(body.markers, name) != body.markers.end();
      });
      if (!goes || !listed.motion.pivot) continue;
      const int numbers = listed.motion.pivot->numbers(dimension);
      listed.motion.pivot = GivenVector::of(numbers, transform(motion, *listed.motion.pivot));
    }
  }
}

void BodyPlan::follow_history() {
  begun_ = false;
  if (done_.empty() || !mesh_.document()) return;
  const History& history = mesh_.document()->history();
  const std::size_t position = history.position();
  ++revision_;
  if (bodies_.empty() && position + 1 == done_at_) {
    bodies_ = done_;
  } else if (bodies_ == done_ && position >= done_at_ &&
             moves_these(history.command(done_at_), done_)) {
    bodies_.clear();
  }
}

const std::vector<std::array<Index, 2>>& BodyPlan::edges_of(
    const std::vector<std::string>& names) const {
  const std::shared_ptr<const Topology>& topology = mesh_.topology();
  if (edges_in_.lock() != topology) {
    edges_.clear();
    edges_in_ = topology;
  }
  const auto known = edges_.find(names);
  if (known != edges_.end()) return known->second;
  return edges_[names] = outline_of(mesh_, markers_named(*topology, names));
}

void BodyPlan::add_outline(const MovingBody& body, Found& found) const {
  const Coordinates& x = mesh_.coordinates();
  const std::vector<Index> nodes = mesh_.topology()->markers().nodes_of(body.markers);
  const RigidMotion motion =
      resolve_motion(body.motion, x.dimension(), body_centre(body_box(x, nodes)));
  for (const auto& [a, b] : edges_of(body.markers))
    found.outline.emplace_back(transform(motion, place_of(x, a)),
                               transform(motion, place_of(x, b)));
}

const BodyPlan::Found& BodyPlan::found() const {
  if (found_ && found_->revision == revision_ && found_->shape == mesh_.shape()) return *found_;
  found_ = Found{revision_, mesh_.shape(), {}, {}};
  if (bodies_.empty() || !mesh_.document() || mesh_.in_motion()) return *found_;
  try {
    make_motion(*mesh_.topology(), mesh_.coordinates(), bodies_);
    for (const MovingBody& body : bodies_) add_outline(body, *found_);
  } catch (const UsageError& error) {
    found_->fault = error.what();
    found_->outline.clear();
  }
  return *found_;
}

}  // namespace winslow::gui
