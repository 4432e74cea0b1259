#include "core/drag/drag_session.h"

#include <condition_variable>

#include "core/drag/drag_predictor.h"
#include "core/error.h"
#include "core/motion/rigid_motion.h"
#include "core/quality/quality.h"
#include "core/strategy/sliding.h"
#include "core/strategy/smooth_run.h"
#include "core/strategy/workspace.h"

namespace winslow {

namespace {

/// The next part of the motion between two poses, with a rotation of at most a quarter turn: beyond
/// half a turn the shorter rotation would be in the opposite direction.
RigidMotion next_part(const RigidMotion& pose, const RigidMotion& target) {
  constexpr double largest_turn = 90;
  RigidMotion way = compose(inverse(pose), target);
  if (std::abs(way.rotate) <= largest_turn) return target;
  const double share = largest_turn / std::abs(way.rotate);
  way.rotate *= share;
  way.translate *= share;
  return compose(pose, way);
}

/// Adds full turns, which a fit to a mesh cannot detect, to a fitted motion: as many as a drag
/// between the poses has made at about this fraction.
RigidMotion with_turns_of(const RigidMotion& from, const RigidMotion& to, double fraction,
                          const RigidMotion& fitted) {
  const RigidMotion& turning = to.rotate != 0 ? to : from;
  const double start = axis_of(from).dot(axis_of(turning)) < 0 ? -from.rotate : from.rotate;
  return with_turns(fitted, turning, start + fraction * (to.rotate - start));
}

}  // namespace

/// The thread and the data shared with its owner. `mutex_` guards all members below it.
class DragSession::Impl final : public SolverMonitor {
  /// A valid intermediate mesh of the current solve.
  struct Passed {
    Coordinates coordinates;
    RigidMotion pose;  // from the state
    double min_sine;
  };
  /// A solved mesh: its tangent fields and the pose of the body.
  struct Prepared {
    DragPredictor predictor;
    RigidMotion pose;                 // from the state
    RigidMotion answered;             // the requested pose; equal to `pose` if it was reached
    std::optional<EdgePair> contact;  // what blocked the motion
  };

 public:
  /// origin: of the state's coordinates, in the coordinates of files.
  Impl(MeshState state, DragGrip grip, const SmoothOptions& options, std::optional<Start> start,
       ResolvedSlide slide, const Vec3& origin)
      : state_(std::move(state)),
        grip_(std::move(grip)),
        options_(options),
        slide_(std::move(slide)),
        origin_(origin),
        resting_(resolve_motion({}, state_.mesh.coordinates.dimension(), Vec3(0, 0, 0))) {
    rest_ = state_.mesh.coordinates;
    frame_ = first_frame(state_, grip_, options_, start ? &*start : nullptr);
    const auto motion =
        make_motion(*state_.mesh.topology, state_.mesh.coordinates, grip_, resting_);
    if (grip_.rigid())
      nodes_.assign(motion->nodes().begin(), motion->nodes().end());
    else
      nodes_ = grip_.nodes;
    bodies_ = body_nodes(*state_.mesh.topology, grip_);
    footholds_ = footholds_of(slide_, what_holds_footholds(options_), state_.mesh, bodies_);
    std::erase_if(footholds_, [](const Foothold& foothold) { return !foothold.goes_on; });
    wanted_ = frame_.motion;
    if (!footholds_.empty()) stood_on_ = state_.mesh;
    const Box<3> body = body_box(state_.mesh.coordinates, nodes_);
    centre_ = body.centre();
    radius_ = 0.5 * body.size().norm();
    solved_ = frame_.coordinates;
    worker_ = std::thread([this] { work(); });
  }
  ~Impl() override {
    {
      const std::lock_guard lock(mutex_);
      quit_ = true;
    }
    wake_.notify_all();
    worker_.join();
  }

  const DragFrame& to(const RigidMotion& motion) {
    std::shared_ptr<const Prepared> prepared;
    std::shared_ptr<const Passed> passed;
    {
      const std::lock_guard lock(mutex_);
      wanted_ = motion;
      prepared = prepared_;
      passed = passed_;
    }
    wake_.notify_all();
    // Back at the start the mesh is the one that was given, to the last bit.
    if (!moves(motion)) return at_rest();
    if (prepared && predict(*prepared, motion)) return frame_;
    frame_.held = !same_motion(frame_.motion, motion);
    frame_.limit = frame_.held && prepared && same_motion(prepared->answered, motion);
    frame_.contact = frame_.held && prepared ? prepared->contact : std::nullopt;
    // Shows the nearest mesh so far while the solve continues.
    if (passed && distance(passed->pose, motion) < distance(frame_.motion, motion)) {
      frame_.coordinates = passed->coordinates;
      frame_.motion = passed->pose;
      frame_.min_sine = passed->min_sine;
    }
    const double whole = distance({}, motion);
    frame_.share =
        whole > 0 ? std::clamp(1 - distance(frame_.motion, motion) / whole, 0.0, 1.0) : 1.0;
    return frame_;
  }

  RigidMotion along(const RigidMotion& motion) const {
    return along_footholds(stood_on_, grip_, footholds_, motion);
  }
  const Vec3& body_centre() const { return centre_; }
  bool ready() const {
    const std::lock_guard lock(mutex_);
    return prepared_ != nullptr;
  }
  bool settled() const {
    const std::lock_guard lock(mutex_);
    return prepared_ && same_motion(prepared_->answered, wanted_);
  }
  int corrections() const {
    const std::lock_guard lock(mutex_);
    return corrections_;
  }
  std::string error() const {
    const std::lock_guard lock(mutex_);
    return error_;
  }

  int revision() const {
    const std::lock_guard lock(mutex_);
    return revision_;
  }

  bool on_iteration(const IterationRecord& record, const Coordinates& x) override {
    std::shared_ptr<const Passed> passed;
    if (record.stage == Stage::path && record.inverted == 0)
      passed = std::make_shared<const Passed>(
          Passed{x, fitted_pose(x, record.fraction), record.min_sine});
    const std::lock_guard lock(mutex_);
    if (passed) {
      passed_ = std::move(passed);
      ++revision_;
    }
    return !quit_;
  }
  bool cancelled() override {
    const std::lock_guard lock(mutex_);
    return quit_;
  }

 private:
  const DragFrame& at_rest() {
    frame_.coordinates = rest_;
    frame_.motion = resting_;
    frame_.min_sine = validity_of(rest_).min_sine;
    frame_.held = frame_.limit = false;
    frame_.share = 1;
    frame_.contact.reset();
    return frame_;
  }
  /// Predicts the frame by the tangent fields. Returns false without a new frame if the predicted
  /// mesh is invalid.
  bool predict(const Prepared& prepared, const RigidMotion& motion) {
    prepared.predictor.evaluate(motion_between(grip_, prepared.pose, motion), candidate_);
    const Validity validity = validity_of(candidate_);
    if (validity.inverted > 0) return false;
    std::swap(frame_.coordinates, candidate_);
    frame_.motion = motion;
    frame_.min_sine = validity.min_sine;
    frame_.held = frame_.limit = false;
    frame_.share = 1;
    frame_.contact.reset();
    return true;
  }

  /// How far nodes of the body move between two poses.
  double distance(const RigidMotion& from, const RigidMotion& to) const {
    return std::abs(radians(compose(inverse(from), to).rotate)) * radius_ +
           (transform(to, centre_) - transform(from, centre_)).norm();
  }

  Validity validity_of(const Coordinates& x) const {
    return check_validity(*state_.mesh.topology, x, options_.threads);
  }

  /// Waits for a position that is not solved yet; empty when the session ends.
  std::optional<RigidMotion> next_target() {
    std::unique_lock lock(mutex_);
    wake_.wait(lock,
               [&] { return quit_ || !prepared_ || !same_motion(wanted_, prepared_->answered); });
    if (quit_) return std::nullopt;
    return wanted_;
  }

  RigidMotion pose() const {
    const std::lock_guard lock(mutex_);
    return prepared_ ? prepared_->pose : wanted_;
  }

  void work() {
    try {
      prepare();
      while (const auto wanted = next_target()) {
        from_ = pose();
        target_ = grip_.rigid() ? next_part(from_, *wanted) : *wanted;
        const RigidMotion target = target_;
        const Coordinates start = solved_;
        contact_.reset();
        const bool whole = solve(target, solved_);
        if (solved_ == start && !reached(target, solved_)) restart(target, solved_);
        const bool there = reached(target, solved_);
        // If the path was blocked, the next attempt waits for another position.
        const bool limit = !there && (!whole || solved_ == start);
        const RigidMotion pose = there ? target : fitted_pose(solved_, 0.5);
        publish(pose, limit ? *wanted : pose, solved_);
      }
    } catch (const Cancelled&) {
      return;
    } catch (const std::exception& e) {
      const std::lock_guard lock(mutex_);
      error_ = e.what();
    }
  }

  /// Projects sliding nodes onto their reference surface, as the command that ends the drag does.
  void prepare() {
    SlideFiles files = slide_.files();
    if (!files.reference) return;
    if (origin_ != Vec3(0, 0, 0)) files.reference = moved_to(*files.reference, origin_);
    slide_ = {options_.slide, std::move(files)};
    ReferenceStart placed = put_on_reference(slide_, state_, &solved_);
    require_no_more_inverted(slide_, state_.mesh, placed.state.mesh);
    // The body does not slide, so its position is unchanged.
    state_.mesh.coordinates = std::move(placed.state.mesh.coordinates);
    solved_ = placed.start ? std::move(*placed.start) : state_.mesh.coordinates;
  }

  /// Follows the path from the last solved mesh to the target pose. Returns false if the path could
  /// not be followed to its end.
  bool solve(const RigidMotion& target, Coordinates& x) {
    const auto motion = make_motion(*state_.mesh.topology, state_.mesh.coordinates, grip_, target);
    const Coordinates start = x;
    RunOptions run;
    run.monitor = this;
    run.start = &start;
    run.cache = &cache_;
    run.files = slide_.files();
    run.bodies = &bodies_;
    const SmoothResult result = smooth_motion(state_, *motion, {}, options_, x, run);
    if (result.contact) contact_ = result.contact->edges;
    if (validity_of(x).inverted > 0) x = start;
    return result.fraction_reached >= 1;
  }

  /// Solves again from the state: a mesh compressed against a wall may have no path back.
  void restart(const RigidMotion& target, Coordinates& x) {
    const auto motion = make_motion(*state_.mesh.topology, state_.mesh.coordinates, grip_, target);
    RunOptions run;
    run.monitor = this;
    run.cache = &cache_;
    run.files = slide_.files();
    run.bodies = &bodies_;
    run.all_or_nothing = true;
    Coordinates other = state_.mesh.coordinates;
    smooth_motion(state_, *motion, {}, options_, other, run);
    if (reached(target, other) && validity_of(other).inverted == 0) x = std::move(other);
  }

  /// answered: the requested position that this mesh answers.
  void publish(const RigidMotion& pose, const RigidMotion& answered, const Coordinates& x) {
    auto prepared = std::make_shared<const Prepared>(
        Prepared{DragPredictor(cache_.workspace().steady_solver(), x, nodes_, grip_.shares,
                               options_.threads),
                 pose, answered, contact_});
    const std::lock_guard lock(mutex_);
    prepared_ = std::move(prepared);
    ++corrections_;
    ++revision_;
  }

  bool reached(const RigidMotion& target, const Coordinates& x) const {
    constexpr double round_off = 1e-12;
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
      const Vec3 rest = place_of(state_.mesh.coordinates, nodes_[i]);
      const Vec3 there =
          grip_.rigid() ? transform(target, rest) : Vec3(rest + grip_.shares[i] * target.translate);
      if ((there - place_of(x, nodes_[i])).norm() > round_off * (1 + there.norm())) return false;
    }
    return true;
  }
  /// The pose of the body in a mesh at about this fraction of the motion from from_ to target_.
  RigidMotion fitted_pose(const Coordinates& x, double fraction) const {
    RigidMotion pose = with_turns_of(from_, target_, fraction,
                                     fit_motion(nodes_, grip_.shares, state_.mesh.coordinates, x));
    // Avoids round-off of the fit in the history.
    constexpr double round_off = 1e-10;  // degrees
    if (std::abs(pose.rotate) < round_off) {
      const Vec3 moved = transform(pose, centre_) - centre_;
      pose.rotate = 0;
      pose.translate = moved;
    }
    return pose;
  }

  MeshState state_;  // its coordinates are the worker's
  DragGrip grip_;
  SmoothOptions options_;
  ResolvedSlide slide_;  // the worker's
  Vec3 origin_;
  RigidMotion resting_;
  Coordinates rest_;  // of the state, where nothing has moved
  std::vector<Index> nodes_;
  BodyNodes bodies_;
  std::vector<Foothold> footholds_;  // that go on
  Mesh stood_on_;                    // the mesh of the footholds
  SolverCache cache_;                // the worker's
  Coordinates solved_;               // the worker's: the mesh solved for last
  RigidMotion from_, target_;        // the worker's: what it is solving for
  std::optional<EdgePair> contact_;  // the worker's: met on the way there
  Vec3 centre_;                      // of the body in the state
  double radius_ = 0;
  DragFrame frame_;        // the owner's
  Coordinates candidate_;  // the owner's

  mutable std::mutex mutex_;
  std::condition_variable wake_;
  bool quit_ = false;
  RigidMotion wanted_;
  std::shared_ptr<const Prepared> prepared_;
  std::shared_ptr<const Passed> passed_;
  int corrections_ = 0, revision_ = 0;
  std::string error_;

  std::thread worker_;
};

namespace {

/// The same motion in the coordinates of the frame.
RigidMotion in_frame(RigidMotion motion, const LocalFrame& frame) {
  motion.pivot = frame.to_local(pivot_of(motion));
  return motion;
}

const Mesh& mesh_of(const MeshState& state) {
  if (state.mesh.topology->cell_dimension() != 3) require_plane(*state.mesh.topology, "drags");
  return state.mesh;
}

}  // namespace

DragFrame DragSession::first_frame(const MeshState& state, const DragGrip& grip,
                                   const SmoothOptions& options, const Start* start) {
  const Mesh& mesh = mesh_of(state);
  validate(options);
  const RigidMotion resting = resolve_motion({}, mesh.coordinates.dimension(), Vec3(0, 0, 0));
  make_motion(*mesh.topology, mesh.coordinates, grip, resting);  // the markers
  DragFrame frame;
  frame.coordinates = start ? start->coordinates : mesh.coordinates;
  frame.motion = start ? start->motion : resting;
  const Validity validity = check_validity(*mesh.topology, frame.coordinates, options.threads);
  if (validity.inverted > 0)
    throw UsageError("a drag starts from a mesh without inverted elements");
  frame.min_sine = validity.min_sine;
  return frame;
}

DragSession::DragSession(MeshState state, DragGrip grip, const SmoothOptions& options,
                         std::optional<Start> start, const SlideFiles& files)
    : frame_(mesh_of(state)), dimension_(state.mesh.coordinates.dimension()) {
  if (frame_.shifts()) {
    rest_ = state.mesh.coordinates;
    state.mesh.coordinates = frame_.to_local(rest_);
    if (state.reference)
      state.reference = std::make_shared<const Coordinates>(frame_.to_local(*state.reference));
  }
  if (start) {
    start->coordinates = frame_.to_local(std::move(start->coordinates));
    start->motion = in_frame(resolve_motion(start->motion, dimension_, Vec3(0, 0, 0)), frame_);
  }
  // Each mesh of a drag begins from the last one, and has to be the same back and forth.
  SmoothOptions local = independent_of_start(options);
  local.slide.interfaces = interfaces_in(local.slide.interfaces, true);
  local.keep_outside = to_local(std::move(local.keep_outside), frame_);
  impl_ = std::make_unique<Impl>(std::move(state), std::move(grip), local, std::move(start),
                                 ResolvedSlide(local.slide, files), frame_.origin());
}
DragSession::~DragSession() = default;

RigidMotion DragSession::along(const RigidMotion& asked) const {
  RigidMotion motion = resolve_motion(asked, dimension_, frame_.to_mesh(impl_->body_centre()));
  const RigidMotion kept = impl_->along(in_frame(motion, frame_));
  motion.rotate = kept.rotate;
  motion.translate = kept.translate;
  return motion;
}

const DragFrame& DragSession::to(const RigidMotion& asked) {
  const RigidMotion motion = along(asked);
  if (!frame_.shifts()) return impl_->to(motion);
  const RigidMotion local = in_frame(motion, frame_);
  shown_ = impl_->to(local);
  shown_.coordinates = frame_.to_mesh(std::move(shown_.coordinates), rest_);
  if (same_motion(shown_.motion, local))
    shown_.motion = motion;
  else
    shown_.motion.pivot = frame_.to_mesh(pivot_of(shown_.motion));
  if (shown_.contact) put_in_mesh(*shown_.contact, frame_);
  return shown_;
}
bool DragSession::ready() const { return impl_->ready(); }
bool DragSession::settled() const { return impl_->settled(); }
int DragSession::corrections() const { return impl_->corrections(); }
int DragSession::revision() const { return impl_->revision(); }
std::string DragSession::error() const { return impl_->error(); }

}  // namespace winslow
