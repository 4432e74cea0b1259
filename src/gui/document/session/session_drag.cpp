#include <cmath>
#include <string>
#include <utility>

#include "core/error.h"
#include "core/motion/rigid_motion.h"
#include "gui/base/text.h"
#include "gui/document/session/session.h"

namespace winslow::gui {

namespace {

constexpr const char* at_work =
    "The solver is at work on something else. Wait until it is done, or cancel it.";

/// The same motion said as turning about `pivot`, without the rounding errors that a fit leaves:
/// the history and recipes would show them. `size`: of the body.
RigidMotion about(const Vec2& pivot, const RigidMotion& motion, double size) {
  RigidMotion said{motion.rotate, pivot, transform(motion, pivot) - pivot};
  constexpr double rounding = 1e-11;
  if (std::abs(said.rotate) < 360 * rounding) said.rotate = 0;
  const double least = rounding * (size + pivot.norm() + said.translate.norm());
  for (int d = 0; d < 2; ++d)
    if (std::abs(said.translate[d]) < least) said.translate[d] = 0;
  return said;
}

bool stays(const RigidMotion& m) { return m.rotate == 0 && m.translate == Vec2(0, 0); }

}  // namespace

void Session::on(const action::BeginDrag& a) {
  if (!document_ || dragging_) return;
  const bool rigid = !a.shape;
  if (rigid ? selection_.empty() : !shape_edit_.arc.has_value()) return;
  drag_base_.reset();
  drag_start_.reset();
  if (job_.active()) {
    if (!rigid || !can_join(selected_names())) return tell(Notice::Kind::warning, at_work);
    drag_base_ = live_motion();
  }
  // Where it was asked for, the boundary goes at once and the mesh may be tangled on the way.
  const bool direct = rigid && motion_.increments == 1;
  DragGrip grip{rigid ? selected_names() : std::vector<std::string>{}, {}, {}};
  if (!rigid)
    grip = grip_of(*shape_edit_.arc, shape_edit_.radius, *boundary_, *document_->topology(),
                   document_->state().mesh.coordinates);
  if (!direct && begin_body_drag(std::move(grip))) {
    dragging_ = true;
    return;
  }
  if (!rigid)
    return tell(Notice::Kind::warning,
                "A tangled mesh cannot follow a change of shape. Smooth it first.");
  if (job_.active()) job_.hold(true);
  dragging_ = true;
}

/// False where the drag can show no valid mesh: the one it would begin from is tangled, or the
/// settings make no sense (then the job says so).
bool Session::begin_body_drag(DragGrip grip) {
  std::optional<DragSession::Start> start;
  if (drag_base_) start = DragSession::Start{job_.coordinates(), *drag_base_};
  const MeshState base = motion_base();
  try {
    drag_.begin(base, std::move(grip), smooth_, start);
  } catch (const UsageError&) {
    return false;
  }
  drag_state_ = base;
  if (start) drag_start_ = std::move(start->coordinates);
  if (job_.active()) job_.cancel();
  banner_.reset();
  shape_changed();
  return true;
}

void Session::on(const action::DragTo& a) {
  if (!dragging_) return;
  const RigidMotion total = drag_base_ ? compose(*drag_base_, a.motion) : a.motion;
  if (drag_.active()) {
    drag_.to(total);
    return shape_changed();
  }
  MoveCommand command = move_command(total);
  // Steps that the user chose are for the place where the body is let go; until then it goes there
  // at once.
  command.how.increments = motion_.increments == 0 ? 0 : 1;
  if (job_.active()) {
    job_.retarget(command);
    return;
  }
  if (!start_job(command, false)) {
    dragging_ = false;
    return;
  }
  job_.hold(true);
}

void Session::on(const action::EndDrag&) {
  if (!dragging_) return;
  dragging_ = false;
  if (drag_.active()) return end_body_drag();
  drag_base_.reset();
  job_.hold(false);
  const auto motion = live_motion();
  if (!motion) return;
  const MoveCommand wanted = move_command(*motion);
  // What has converged under the mouse needs no second run, unless other steps were asked for.
  if (wanted.how.increments <= 1 && job_.converged())
    job_.rename(wanted);
  else
    job_.retarget(wanted);
}

/// The command that the drag has shown is carried out from the mesh on screen, so that it is done
/// after an iteration or two.
void Session::end_body_drag() {
  // What the handle said while it was held: this far and no further.
  const bool limit = drag_.reach() == BodyDrag::Reach::limit;
  const RigidMotion motion = limit ? drag_.frame().motion : drag_.wanted();
  const DragGrip grip = drag_.grip();
  std::optional<Coordinates> start = drag_.frame().coordinates;
  drag_.end();
  drag_base_.reset();
  drag_start_.reset();
  shape_changed();
  // Nothing was done, and what was to be said of the mesh is to be said still.
  if (stays(motion)) return banner_of_position();
  if (motion_.increments > 1) start.reset();
  start_job(drag_command(grip, motion, motion_, smooth_), false, std::move(start));
}

void Session::on(const action::CancelDrag&) {
  if (!dragging_) return;
  dragging_ = false;
  const std::optional<RigidMotion> base = std::exchange(drag_base_, std::nullopt);
  if (drag_.active()) {
    drag_.end();
    shape_changed();
    banner_of_position();
    // The job that the drag had taken over goes on to where it was going.
    if (base) start_job(move_command(*base), false, std::exchange(drag_start_, std::nullopt));
  } else if (base) {
    job_.hold(false);
    job_.retarget(move_command(*base));
  } else {
    job_.hold(false);
    stop_job();
  }
  tell(Notice::Kind::information, "Drag cancelled");
}

/// A path that could not be followed to its end leaves the boundary where it got to. The history
/// must say that, not what was asked for: a recipe replayed gives this mesh.
void Session::settle_motion(JobRunner::Outcome& outcome) {
  const double fraction = outcome.result->smooth.fraction_reached;
  if (fraction >= 1) return;
  const Coordinates& rest = job_.base().mesh.coordinates;
  const Coordinates& now = outcome.result->state.mesh.coordinates;
  if (auto* move = std::get_if<MoveCommand>(&outcome.command)) {
    const std::vector<Index> nodes = document_->topology()->nodes_of_markers(move->markers);
    RigidMotion reached = fit_rigid_motion(nodes, rest, now);
    // Full turns do not show in where the body is.
    const double turned = (job_.started_elsewhere() ? 1 : fraction) * move->motion.rotate;
    reached.rotate += 360 * std::round((turned - reached.rotate) / 360);
    move->motion = about(move->motion.pivot, reached, bounds(rest, nodes).size().norm());
  } else if (auto* deform = std::get_if<DeformCommand>(&outcome.command)) {
    if (auto* sine = std::get_if<SineDeformation>(&deform->shape)) sine->amplitude *= fraction;
    if (auto* table = std::get_if<DisplacementTable>(&deform->shape))
      for (DisplacementEntry& entry : table->entries) {
        if (entry.node)
          entry.displacement = now.xy(*entry.node) - rest.xy(*entry.node);
        else
          entry.displacement *= fraction;
      }
  }
  banner_ = Banner{Banner::Kind::partial_motion, "No valid mesh was found beyond " +
                                                     short_number(100 * fraction) +
                                                     " % of the way: the body is where it got to."};
}

}  // namespace winslow::gui
