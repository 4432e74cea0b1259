#include "core/drag/drag_session.h"

#include <algorithm>
#include <cmath>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <thread>

#include "core/drag/drag_predictor.h"
#include "core/error.h"
#include "core/motion/rigid_motion.h"
#include "core/quality/quality.h"
#include "core/strategy/smooth_run.h"
#include "core/strategy/workspace.h"

namespace winslow {

namespace {

/// A motion from one pose to another in parts that turn by no more than a quarter: beyond half a
/// turn the way back would be the shorter one.
RigidMotion next_part(const RigidMotion& pose, const RigidMotion& target) {
  constexpr double largest_turn = 90;
  RigidMotion way = compose(inverse(pose), target);
  if (std::abs(way.rotate) <= largest_turn) return target;
  const double share = largest_turn / std::abs(way.rotate);
  way.rotate *= share;
  way.translate *= share;
  return compose(pose, way);
}

}  // namespace

/// The thread and what it shares with its owner. What lies below `mutex_` is guarded by it.
class DragSession::Impl final : public SolverMonitor {
  /// A solved mesh: its tangent fields and where the body is in it.
  struct Prepared {
    DragPredictor predictor;
    RigidMotion pose;      // from the state
    RigidMotion answered;  // what was asked for; the pose where it could be reached
  };

 public:
  Impl(MeshState state, DragGrip grip, const SmoothOptions& options, std::optional<Start> start)
      : state_(std::move(state)), grip_(std::move(grip)), options_(options) {
    validate(options_);
    const auto motion =
        make_motion(*state_.mesh.topology, state_.mesh.coordinates, grip_, RigidMotion{});
    if (grip_.rigid())
      nodes_.assign(motion->nodes().begin(), motion->nodes().end());
    else
      nodes_ = grip_.nodes;
    frame_.coordinates = start ? std::move(start->coordinates) : state_.mesh.coordinates;
    frame_.motion = start ? start->motion : RigidMotion{};
    const Validity validity = validity_of(frame_.coordinates);
    if (validity.inverted > 0)
      throw UsageError("a drag starts from a mesh without inverted elements");
    frame_.min_sine = validity.min_sine;
    wanted_ = frame_.motion;
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
    {
      const std::lock_guard lock(mutex_);
      wanted_ = motion;
      prepared = prepared_;
    }
    wake_.notify_all();
    if (!prepared) {
      frame_.held = !same_motion(frame_.motion, motion);
      return frame_;
    }
    prepared->predictor.evaluate(motion_between(grip_, prepared->pose, motion), candidate_);
    const Validity validity = validity_of(candidate_);
    frame_.held = validity.inverted > 0;
    frame_.limit = frame_.held && same_motion(prepared->answered, motion);
    if (frame_.held) return frame_;
    std::swap(frame_.coordinates, candidate_);
    frame_.motion = motion;
    frame_.min_sine = validity.min_sine;
    return frame_;
  }

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

  bool on_iteration(const IterationRecord&, const Coordinates&) override {
    const std::lock_guard lock(mutex_);
    return !quit_;
  }

 private:
  Validity validity_of(const Coordinates& x) const {
    return check_validity(*state_.mesh.topology, x, options_.threads);
  }

  /// Waits for a position that is not solved for yet; empty when the session ends.
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
      while (const auto wanted = next_target()) {
        const RigidMotion target = grip_.rigid() ? next_part(pose(), *wanted) : *wanted;
        const Coordinates start = solved_;
        const bool whole = solve(target, solved_);
        if (solved_ == start && !reached(target, solved_)) restart(target, solved_);
        const bool there = reached(target, solved_);
        // Where the path ended on the way, the next try waits for another position.
        const bool limit = !there && (!whole || solved_ == start);
        const RigidMotion pose = there ? target : fitted_pose(solved_);
        publish(pose, limit ? *wanted : pose, solved_);
      }
    } catch (const Cancelled&) {
      return;
    } catch (const std::exception& e) {
      const std::lock_guard lock(mutex_);
      error_ = e.what();
    }
  }

  /// From the mesh solved for last along the path to where the body is wanted. False if the path
  /// could not be followed to its end.
  bool solve(const RigidMotion& target, Coordinates& x) {
    const auto motion = make_motion(*state_.mesh.topology, state_.mesh.coordinates, grip_, target);
    const Coordinates start = x;
    RunOptions run;
    run.monitor = this;
    run.start = &start;
    run.workspace = &workspace_;
    const SmoothResult result = smooth_motion(state_, *motion, {}, options_, x, run);
    if (validity_of(x).inverted > 0) x = start;
    return result.fraction_reached >= 1;
  }

  /// A mesh pressed against a wall may find no way back: the way from the state may be open.
  void restart(const RigidMotion& target, Coordinates& x) {
    const auto motion = make_motion(*state_.mesh.topology, state_.mesh.coordinates, grip_, target);
    RunOptions run;
    run.monitor = this;
    run.workspace = &workspace_;
    Coordinates other = state_.mesh.coordinates;
    smooth_motion(state_, *motion, {}, options_, other, run);
    if (reached(target, other) && validity_of(other).inverted == 0) x = std::move(other);
  }

  /// answered: the position asked for that this mesh is the answer to.
  void publish(const RigidMotion& pose, const RigidMotion& answered, const Coordinates& x) {
    auto prepared = std::make_shared<const Prepared>(Prepared{
        DragPredictor(workspace_.steady_solver(), x, nodes_, grip_.shares, options_.threads), pose,
        answered});
    const std::lock_guard lock(mutex_);
    prepared_ = std::move(prepared);
    ++corrections_;
  }

  bool reached(const RigidMotion& target, const Coordinates& x) const {
    constexpr double round_off = 1e-12;
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
      const Vec2 rest = state_.mesh.coordinates.xy(nodes_[i]);
      const Vec2 there =
          grip_.rigid() ? transform(target, rest) : Vec2(rest + grip_.shares[i] * target.translate);
      if ((there - x.xy(nodes_[i])).norm() > round_off * (1 + there.norm())) return false;
    }
    return true;
  }
  RigidMotion fitted_pose(const Coordinates& x) const {
    return fit_motion(nodes_, grip_.shares, state_.mesh.coordinates, x);
  }

  MeshState state_;
  DragGrip grip_;
  SmoothOptions options_;
  std::vector<Index> nodes_;
  SmoothingWorkspace workspace_;  // the worker's
  Coordinates solved_;            // the worker's: the mesh solved for last
  DragFrame frame_;               // the owner's
  Coordinates candidate_;         // the owner's

  mutable std::mutex mutex_;
  std::condition_variable wake_;
  bool quit_ = false;
  RigidMotion wanted_;
  std::shared_ptr<const Prepared> prepared_;
  int corrections_ = 0;
  std::string error_;

  std::thread worker_;
};

namespace {

/// The same motion, of points counted from elsewhere.
RigidMotion with_pivot_at(const Vec2& pivot, const RigidMotion& motion) {
  return {motion.rotate, pivot, motion.translate};
}

const Mesh& plane_mesh_of(const MeshState& state) {
  require_plane(*state.mesh.topology, "motions");
  return state.mesh;
}

std::optional<DragSession::Start> in_frame(std::optional<DragSession::Start> start,
                                           const LocalFrame& frame) {
  if (!start || !frame.shifts()) return start;
  start->coordinates = frame.to_local(std::move(start->coordinates));
  start->motion = with_pivot_at(frame.to_local(start->motion.pivot), start->motion);
  return start;
}

}  // namespace

DragSession::DragSession(MeshState state, DragGrip grip, const SmoothOptions& options,
                         std::optional<Start> start)
    : frame_(plane_mesh_of(state)) {
  if (frame_.shifts()) {
    rest_ = state.mesh.coordinates;
    state.mesh.coordinates = frame_.to_local(rest_);
  }
  impl_ = std::make_unique<Impl>(std::move(state), std::move(grip), options,
                                 in_frame(std::move(start), frame_));
}
DragSession::~DragSession() = default;

const DragFrame& DragSession::to(const RigidMotion& motion) {
  if (!frame_.shifts()) return impl_->to(motion);
  const RigidMotion local = with_pivot_at(frame_.to_local(motion.pivot), motion);
  shown_ = impl_->to(local);
  shown_.coordinates = frame_.to_mesh(std::move(shown_.coordinates), rest_);
  shown_.motion = same_motion(shown_.motion, local)
                      ? motion
                      : with_pivot_at(frame_.to_mesh(shown_.motion.pivot), shown_.motion);
  return shown_;
}
bool DragSession::ready() const { return impl_->ready(); }
bool DragSession::settled() const { return impl_->settled(); }
int DragSession::corrections() const { return impl_->corrections(); }
std::string DragSession::error() const { return impl_->error(); }

}  // namespace winslow
