#include "gui/document/jobs/job_runner.h"

#include "core/motion/rigid_motion.h"

namespace winslow::gui {

bool JobRunner::paused() const { return active_ && pause_requested_; }

void JobRunner::run(MeshState base, Command command, bool paused, std::optional<Coordinates> start,
                    ResolveFiles files) {
  base_ = std::make_shared<const MeshState>(std::move(base));
  const MeshState* const mesh = base_.get();
  command_ = with_pivot(std::move(command), std::span(&mesh, 1));
  snapshot_.reset();
  active_ = true;
  held_ = false;
  pause_requested_ = paused;
  started_ = std::chrono::steady_clock::now();
  start_ = start;
  solver_.resolve([files = std::move(files)](const Command& asked) {
    const SmoothOptions* smooth = smooth_options(asked);
    return ResolvedCommand(asked, smooth ? files(smooth->slide) : SlideFiles{});
  });
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
  // A finished job is restarted with a new number.
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

void JobRunner::wait_for_viewer(bool on) {
  if (on)
    solver_.wait_for_viewer(snapshot_ ? snapshot_->serial : 0);
  else
    solver_.wait_for_viewer({});
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
  return reached && reached->bodies == target->bodies;
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

/// The same motion expressed as a rotation about `pivot`, without the rounding errors of a fit,
/// which the history and recipes would show. `size`: of the body.
RigidMotion about(const Vec3& pivot, const RigidMotion& motion, double size) {
  RigidMotion said = motion;
  said.pivot = pivot;
  said.translate = Vec3(transform(motion, pivot) - pivot);
  constexpr double rounding = 1e-11;
  if (std::abs(said.rotate) < 360 * rounding) said.rotate = 0;
  // Rounding errors of the coordinates, of the fit, and of the offset from its centre to the pivot.
  const double round_off = 16 * std::numeric_limits<double>::epsilon() * pivot.norm();
  const double arm = (pivot - pivot_of(motion)).norm();
  const double least = rounding * (size + arm + said.translate.norm()) + round_off;
  for (auto& component : said.translate)
    if (std::abs(component) < least) component = 0;
  return said;
}

/// The share of a requested motion that a body has reached, measured by the paths of its nodes.
double share_of(const RigidMotion& reached, const RigidMotion& asked, const Box<3>& body) {
  const Vec3 centre = body.centre();
  const double radius = 0.5 * body.size().norm();
  const auto way = [&](const RigidMotion& from, const RigidMotion& to) {
    return std::abs(radians(compose(inverse(from), to).rotate)) * radius +
           (transform(to, centre) - transform(from, centre)).norm();
  };
  const double whole = way({}, asked);
  return whole > 0 ? std::clamp(1 - way(reached, asked) / whole, 0.0, 1.0) : 1;
}

/// base, now: the mesh before and after the motion. Returns the reached share of the motion.
double settle(MovingBody& moving, double fraction, const Mesh& base, const Coordinates& now,
              bool started_elsewhere) {
  const Coordinates& rest = base.coordinates;
  const RigidMotion asked = resolve_motion(moving.motion, rest.dimension(), Vec3(0, 0, 0));
  const std::vector<Index> nodes = base.topology->markers().nodes_of(moving.markers);
  // Fit the motion to the positions of the nodes. Positions do not determine full turns, which are
  // taken from that share of the requested rotation.
  const double share = started_elsewhere ? 1 : fraction;
  const RigidMotion reached =
      with_turns(fit_rigid_motion(nodes, rest, now), asked, share * asked.rotate);
  const Box<3> body = body_box(rest, nodes);
  // The fraction of a run that began part-way does not refer to the whole path.
  if (started_elsewhere) fraction = share_of(reached, asked, body);
  moving.motion = about(pivot_of(asked), reached, body.size().norm());
  return fraction;
}

double settle(MoveCommand& move, double fraction, const Mesh& base, const Coordinates& now,
              bool started_elsewhere) {
  double reached = 1;
  for (MovingBody& body : move.bodies)
    reached = std::min(reached, settle(body, fraction, base, now, started_elsewhere));
  return reached;
}

void settle(DeformCommand& deform, double fraction, const Coordinates& rest,
            const Coordinates& now) {
  if (auto* sine = std::get_if<SineDeformation>(&deform.shape)) sine->amplitude *= fraction;
  if (auto* positions = std::get_if<PositionTable>(&deform.shape))
    for (PositionEntry& entry : positions->entries)
      entry.position = GivenVector::of(now.dimension(), place_of(now, entry.node));
  auto* table = std::get_if<DisplacementTable>(&deform.shape);
  if (!table) return;
  for (DisplacementEntry& entry : table->entries) {
    if (entry.node)
      entry.displacement = GivenVector::of(
          now.dimension(), place_of(now, *entry.node) - place_of(rest, *entry.node));
    else
      entry.displacement *= fraction;
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
