#include "gui/document/jobs/job_runner.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/motion/rigid_motion.h"

namespace winslow::gui {

JobRunner::JobRunner(std::shared_ptr<ReferenceFiles> references) {
  solver_.prepare([files = std::move(references)](Command& command) { files->load(command); });
}

bool JobRunner::paused() const { return active_ && pause_requested_; }

void JobRunner::run(MeshState base, Command command, bool paused,
                    std::optional<Coordinates> start) {
  base_ = std::make_shared<const MeshState>(std::move(base));
  const MeshState* const mesh = base_.get();
  command_ = with_pivot(std::move(command), std::span(&mesh, 1));
  snapshot_.reset();
  active_ = true;
  held_ = false;
  pause_requested_ = paused;
  started_ = std::chrono::steady_clock::now();
  start_ = start;
  job_ = solver_.run(base_, command_, std::move(start), paused);
}

const Coordinates& JobRunner::coordinates() const {
  if (snapshot_ && snapshot_->mesh) return snapshot_->mesh->coordinates;
  return start_ ? *start_ : base_->mesh.coordinates;
}

const std::shared_ptr<const Topology>& JobRunner::topology() const {
  if (snapshot_ && snapshot_->mesh) return snapshot_->mesh->topology;
  return base_->mesh.topology;
}

void JobRunner::retarget(Command command) {
  command_ = std::move(command);
  pause_requested_ = false;
  solver_.retarget(command_);
  solver_.resume();
  // A job that had ended starts again under a new number.
  job_ = solver_.latest()->job;
}

bool JobRunner::converged() const {
  if (!snapshot_ || snapshot_->state != JobState::done || !meets_target(*snapshot_)) return false;
  const auto& result = snapshot_->result;
  return result && result->smooth.converged && result->smooth.inverted == 0;
}

void JobRunner::pause() {
  if (!active_) return;
  pause_requested_ = true;
  solver_.pause();
}

void JobRunner::resume() {
  if (!active_) return;
  pause_requested_ = false;
  solver_.resume();
}

void JobRunner::step(int count) {
  if (!active_) return;
  pause_requested_ = true;
  solver_.step(count);
}

void JobRunner::set_pace(double iterations_per_second) {
  if (iterations_per_second == pace_) return;
  pace_ = iterations_per_second;
  solver_.set_pace(pace_);
}

void JobRunner::follow(bool on) {
  if (on)
    solver_.follow(snapshot_ ? snapshot_->serial : 0);
  else
    solver_.follow({});
}

void JobRunner::cancel() {
  if (!active_) return;
  solver_.cancel();
  active_ = held_ = pause_requested_ = false;
  snapshot_.reset();
}

bool JobRunner::poll() {
  if (!active_) return false;
  auto latest = solver_.latest();
  if (latest->job != job_) return false;
  if (snapshot_ && snapshot_->serial == latest->serial) return false;
  snapshot_ = std::move(latest);
  return true;
}

bool JobRunner::meets_target(const Snapshot& snapshot) const {
  if (const auto* edit = std::get_if<EditVcvCommand>(&command_)) {
    const auto* done = snapshot.command ? std::get_if<EditVcvCommand>(&*snapshot.command) : nullptr;
    return done && done->edits == edit->edits;
  }
  const auto* target = std::get_if<MoveCommand>(&command_);
  if (!target) return true;
  if (!snapshot.command) return false;
  const auto* reached = std::get_if<MoveCommand>(&*snapshot.command);
  return reached && reached->motion == target->motion;
}

std::optional<JobRunner::Outcome> JobRunner::take_outcome() {
  if (!active_ || held_ || !snapshot_) return std::nullopt;
  const JobState state = snapshot_->state;
  if (state != JobState::done && state != JobState::failed && state != JobState::cancelled)
    return std::nullopt;
  // A drag may have moved on since this snapshot was published.
  if (!meets_target(*snapshot_)) return std::nullopt;
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - started_;
  Outcome outcome{command_, snapshot_->result, snapshot_->error, taken.count(), pause_requested_};
  active_ = pause_requested_ = false;
  snapshot_.reset();
  return outcome;
}

namespace {

/// Of what moves: in the plane and in space.
Bounds body_bounds(const Coordinates& x, const std::vector<Index>& nodes, const RigidMotion&) {
  return bounds(x, nodes);
}
Box<3> body_bounds(const Coordinates& x, const std::vector<Index>& nodes, const SpaceMotion&) {
  return space_bounds(x, nodes);
}

/// Where the nodes are in `now`, with the full turns of what was asked for, of which about `share`
/// is done: those do not show in where the body is.
RigidMotion fitted(const RigidMotion& asked, double share, const std::vector<Index>& nodes,
                   const Coordinates& rest, const Coordinates& now) {
  return with_turns(fit_rigid_motion(nodes, rest, now), share * asked.rotate);
}
SpaceMotion fitted(const SpaceMotion& asked, double share, const std::vector<Index>& nodes,
                   const Coordinates& rest, const Coordinates& now) {
  return with_turns(fit_space_motion(nodes, rest, now), asked.axis, share * asked.rotate);
}

/// The same motion said as turning about `pivot`, without the rounding errors that a fit leaves:
/// the history and recipes would show them. `size`: of the body.
template <typename Pose, typename Point>
Pose about(const Point& pivot, const Pose& motion, double size) {
  Pose said = motion;
  said.pivot = pivot;
  said.translate = transform(motion, pivot) - pivot;
  constexpr double rounding = 1e-11;
  if (std::abs(said.rotate) < 360 * rounding) said.rotate = 0;
  // Of coordinates, and of what the fit and the way from its centre to the pivot make of them.
  const double round_off = 16 * std::numeric_limits<double>::epsilon() * pivot.norm();
  const double arm = (pivot - motion.pivot).norm();
  const double least = rounding * (size + arm + said.translate.norm()) + round_off;
  for (auto& component : said.translate)
    if (std::abs(component) < least) component = 0;
  return said;
}

/// How far a body came of a motion that was asked for: of the way of its nodes.
template <typename Pose, typename Body>
double share_of(const Pose& reached, const Pose& asked, const Body& body) {
  const auto centre = body.centre();
  const double radius = 0.5 * body.size().norm();
  const auto way = [&](const Pose& from, const Pose& to) {
    return std::abs(radians(compose(inverse(from), to).rotate)) * radius +
           (transform(to, centre) - transform(from, centre)).norm();
  };
  const double whole = way({}, asked);
  return whole > 0 ? std::clamp(1 - way(reached, asked) / whole, 0.0, 1.0) : 1;
}

/// rest, now: positions before the motion and where it got to. Returns the share of the motion that
/// was reached.
template <typename Pose>
double settle(MoveCommand& move, const Pose& asked, double fraction, const Mesh& base,
              const Coordinates& now, bool started_elsewhere) {
  const Coordinates& rest = base.coordinates;
  const std::vector<Index> nodes = base.topology->markers().nodes_of(move.markers);
  const Pose reached = fitted(asked, started_elsewhere ? 1 : fraction, nodes, rest, now);
  const auto body = body_bounds(rest, nodes, asked);
  // The fraction of a run that began on the way says nothing of the whole way.
  if (started_elsewhere) fraction = share_of(reached, asked, body);
  move.motion = about(asked.pivot, reached, body.size().norm());
  return fraction;
}

double settle(MoveCommand& move, double fraction, const Mesh& base, const Coordinates& now,
              bool started_elsewhere) {
  if (base.topology->cell_dimension() == 3)
    return settle(move, move.motion.in_space(Vec3(0, 0, 0)), fraction, base, now,
                  started_elsewhere);
  return settle(move, move.motion.about(Vec2(0, 0)), fraction, base, now, started_elsewhere);
}

void settle(DeformCommand& deform, double fraction, const Coordinates& rest,
            const Coordinates& now) {
  if (auto* sine = std::get_if<SineDeformation>(&deform.shape)) sine->amplitude *= fraction;
  auto* table = std::get_if<DisplacementTable>(&deform.shape);
  if (!table) return;
  for (DisplacementEntry& entry : table->entries) {
    if (entry.node && now.dimension() == 3) {
      const Vec3 by = now.xyz(*entry.node) - rest.xyz(*entry.node);
      entry.displacement = by.head<2>();
      entry.displacement_z = by.z();
    } else if (entry.node) {
      entry.displacement = now.xy(*entry.node) - rest.xy(*entry.node);
    } else {
      entry.displacement *= fraction;
      if (entry.displacement_z) *entry.displacement_z *= fraction;
    }
  }
}

}  // namespace

double settle_command(JobRunner::Outcome& outcome, const Mesh& base, bool started_elsewhere) {
  const double fraction = outcome.result->smooth.fraction_reached;
  if (fraction >= 1) return 1;
  const Coordinates& now = outcome.result->state.mesh.coordinates;
  if (auto* move = std::get_if<MoveCommand>(&outcome.command))
    return settle(*move, fraction, base, now, started_elsewhere);
  if (auto* deform = std::get_if<DeformCommand>(&outcome.command))
    settle(*deform, fraction, base.coordinates, now);
  return fraction;
}

}  // namespace winslow::gui
