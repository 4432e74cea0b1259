#include "core/drag/drag_session.h"

#include <algorithm>
#include <cmath>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <thread>

#include "core/command/smooth_run.h"
#include "core/command/workspace.h"
#include "core/drag/drag_predictor.h"
#include "core/error.h"
#include "core/motion/rigid_motion.h"
#include "core/quality/quality.h"

namespace winslow {

namespace {

/// A solved mesh: its tangent fields and where the body is in it.
struct Prepared {
  DragPredictor predictor;
  RigidMotion pose;    // from the state
  RigidMotion target;  // what was asked for; the pose where it could be reached
};

}  // namespace

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

/// The thread and what it shares with its owner. What lies below `mutex_` is guarded by it.
class DragSession::Impl final : public SolverMonitor {
 public:
  Impl(MeshState state, const std::vector<std::string>& markers, const SmoothOptions& options)
      : state_(std::move(state)), markers_(markers), options_(options) {
    validate(options_);
    const auto motion =
        make_motion(*state_.mesh.topology, state_.mesh.coordinates, markers_, RigidMotion{});
    nodes_.assign(motion->nodes().begin(), motion->nodes().end());
    const Validity validity = validity_of(state_.mesh.coordinates);
    if (validity.inverted > 0)
      throw UsageError("a drag starts from a mesh without inverted elements");
    frame_.coordinates = state_.mesh.coordinates;
    frame_.min_sine = validity.min_sine;
    frame_.held = true;
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
    if (!prepared) return frame_;
    prepared->predictor.evaluate(compose(inverse(prepared->pose), motion), candidate_);
    const Validity validity = validity_of(candidate_);
    frame_.held = validity.inverted > 0;
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
    return prepared_ && same_motion(prepared_->target, wanted_);
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
               [&] { return quit_ || !prepared_ || !same_motion(wanted_, prepared_->target); });
    if (quit_) return std::nullopt;
    return wanted_;
  }

  RigidMotion pose() const {
    const std::lock_guard lock(mutex_);
    return prepared_ ? prepared_->pose : RigidMotion{};
  }

  void work() {
    try {
      Coordinates solved = state_.mesh.coordinates;
      while (const auto wanted = next_target()) {
        const RigidMotion target = next_part(pose(), *wanted);
        const Coordinates start = solved;
        solve(target, solved);
        if (solved == start && !reached(target, solved)) restart(target, solved);
        // Where it was no use, the next try waits for another position.
        const bool settled = reached(target, solved) || solved == start;
        publish(settled ? target : fitted_pose(solved), solved);
      }
    } catch (const Cancelled&) {
      return;
    } catch (const std::exception& e) {
      const std::lock_guard lock(mutex_);
      error_ = e.what();
    }
  }

  /// From the mesh solved for last along the path to where the body is wanted.
  void solve(const RigidMotion& target, Coordinates& x) {
    const auto motion =
        make_motion(*state_.mesh.topology, state_.mesh.coordinates, markers_, target);
    const Coordinates start = x;
    ExecuteOptions run;
    run.monitor = this;
    run.start = &start;
    run.workspace = &workspace_;
    smooth_motion(state_, *motion, {}, options_, x, run);
    if (validity_of(x).inverted > 0) x = start;
  }

  /// A mesh pressed against a wall may find no way back: the way from the state may be open.
  void restart(const RigidMotion& target, Coordinates& x) {
    const auto motion =
        make_motion(*state_.mesh.topology, state_.mesh.coordinates, markers_, target);
    ExecuteOptions run;
    run.monitor = this;
    run.workspace = &workspace_;
    Coordinates other = state_.mesh.coordinates;
    smooth_motion(state_, *motion, {}, options_, other, run);
    if (reached(target, other) && validity_of(other).inverted == 0) x = std::move(other);
  }

  void publish(const RigidMotion& target, const Coordinates& x) {
    auto prepared = std::make_shared<const Prepared>(
        Prepared{DragPredictor(*state_.mesh.topology, workspace_.steady_solver(), x, nodes_,
                               options_.threads),
                 reached(target, x) ? target : fitted_pose(x), target});
    const std::lock_guard lock(mutex_);
    prepared_ = std::move(prepared);
    ++corrections_;
  }

  bool reached(const RigidMotion& target, const Coordinates& x) const {
    constexpr double round_off = 1e-12;
    return std::all_of(nodes_.begin(), nodes_.end(), [&](Index node) {
      const Vec2 there = transform(target, state_.mesh.coordinates.xy(node));
      return (there - x.xy(node)).norm() <= round_off * (1 + there.norm());
    });
  }
  RigidMotion fitted_pose(const Coordinates& x) const {
    return fit_rigid_motion(nodes_, state_.mesh.coordinates, x);
  }

  MeshState state_;
  std::vector<std::string> markers_;
  SmoothOptions options_;
  std::vector<Index> nodes_;
  SmoothingWorkspace workspace_;  // the worker's
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

DragSession::DragSession(MeshState state, const std::vector<std::string>& markers,
                         const SmoothOptions& options)
    : impl_(std::make_unique<Impl>(std::move(state), markers, options)) {}
DragSession::~DragSession() = default;

const DragFrame& DragSession::to(const RigidMotion& motion) { return impl_->to(motion); }
bool DragSession::ready() const { return impl_->ready(); }
bool DragSession::settled() const { return impl_->settled(); }
int DragSession::corrections() const { return impl_->corrections(); }
std::string DragSession::error() const { return impl_->error(); }

}  // namespace winslow
