#include "gui/document/session/motions.h"

#include <string>
#include <utility>

#include "core/error.h"
#include "core/motion/rigid_motion.h"
#include "gui/document/jobs/body_drag.h"

namespace winslow::gui {

namespace {

constexpr const char* at_work =
    "The solver is at work on something else. Wait until it is done, or cancel it.";

bool stays(const RigidMotionRequest& m) {
  return m.rotate == 0 && m.translate == Vec2(0, 0) && m.translate_z.value_or(0) == 0;
}

}  // namespace

void Motions::on(const action::ApplyMotion& a) {
  if (!mesh_.document() || selection_.empty() || mesh_.held().body) return;
  if (!jobs_.can_join(selection_.names())) {
    jobs_.start(jobs_.move_command(a.motion), false);
  } else {
    const bool space = in_space(mesh_);
    const RigidMotionRequest more =
        space ? RigidMotionRequest(a.motion.in_space(selection_.space_pivot()))
              : a.motion.about(selection_.pivot());
    mesh_.job().retarget(jobs_.move_command(compose(*live_request(mesh_), more, space)));
  }
}

void Motions::on(const action::ApplyDeformation& a) {
  if (!mesh_.document() || selection_.empty() || mesh_.held().body) return;
  selection_.drop_preview();
  jobs_.start(DeformCommand{selection_.names(), a.shape, jobs_.motion_options(),
                            jobs_.smooth_for_motion(selection_.names())},
              false);
}

void Motions::on(const action::SetShapeEdit& a) {
  const bool dragging = mesh_.held().body;
  if (!mesh_.document() || (dragging && !a.active)) return;
  selection_.edit_shape(a.active, a.radius);
  const BodyDrag* drag = mesh_.body_drag();
  if (!dragging || !drag || drag->grip().rigid() || !selection_.shape_edit().holds()) return;
  // The same pull on another part of the boundary.
  const RigidMotionRequest pull = drag->wanted();
  begin_body_drag(shape_grip());
  mesh_.drag().to(pull);
  mesh_.changed();
}

DragGrip Motions::shape_grip() const {
  const ShapeEdit& edit = selection_.shape_edit();
  const Mesh& mesh = std::as_const(mesh_).document()->state().mesh;
  if (const auto* held = selection_.space().held(edit)) return held->grip;
  return grip_of(*edit.arc, edit.radius, *mesh_.boundary(), *mesh.topology, mesh.coordinates);
}

void Motions::on(const action::BeginDrag& a) {
  if (!mesh_.document() || mesh_.held().body) return;
  const bool rigid = !a.shape;
  if (rigid ? selection_.empty() : !selection_.shape_edit().holds()) return;
  base_.reset();
  start_.reset();
  if (mesh_.job().active()) {
    if (!rigid || !jobs_.can_join(selection_.names()))
      return messages_.tell(Notice::Kind::warning, at_work);
    base_ = live_request(mesh_);
  }
  // Where it was asked for, the boundary goes at once and the mesh may be tangled on the way.
  const bool direct = rigid && jobs_.motion_options().increments == 1;
  DragGrip grip = rigid ? DragGrip{selection_.names(), {}, {}} : shape_grip();
  if (!direct && begin_body_drag(std::move(grip))) {
    mesh_.held().body = true;
    return;
  }
  if (!rigid)
    return messages_.tell(Notice::Kind::warning,
                          "A tangled mesh cannot follow a change of shape. Smooth it first.");
  if (mesh_.job().active()) mesh_.job().hold(true);
  mesh_.held().body = true;
}

/// False where the drag can show no valid mesh: the one it would begin from is tangled, or the
/// settings make no sense (then the job says so).
bool Motions::begin_body_drag(DragGrip grip) {
  std::optional<BodyDrag::Start> start;
  if (base_) start = BodyDrag::Start{mesh_.job().coordinates(), *base_};
  try {
    const SmoothOptions smooth = jobs_.smooth_for_motion(grip.markers);
    mesh_.begin_drag(std::move(grip), smooth, start);
  } catch (const UsageError&) {
    return false;
  }
  if (start) start_ = std::move(start->coordinates);
  if (mesh_.job().active()) mesh_.job().cancel();
  messages_.clear_banner();
  mesh_.changed();
  return true;
}

void Motions::on(const action::DragTo& a) {
  if (!mesh_.held().body) return;
  const RigidMotionRequest total = base_ ? compose(*base_, a.motion, in_space(mesh_)) : a.motion;
  if (mesh_.body_drag()) {
    mesh_.drag().to(total);
    return mesh_.changed();
  }
  MoveCommand command = jobs_.move_command(total);
  // Steps that the user chose are for the place where the body is let go; until then it goes there
  // at once.
  command.how.increments = jobs_.motion_options().increments == 0 ? 0 : 1;
  if (mesh_.job().active()) {
    mesh_.job().retarget(command);
    return;
  }
  if (!jobs_.start(command, false)) {
    mesh_.held().body = false;
    return;
  }
  mesh_.job().hold(true);
}

void Motions::on(const action::EndDrag&) {
  if (!std::exchange(mesh_.held().body, false)) return;
  if (mesh_.body_drag()) return end_body_drag();
  base_.reset();
  mesh_.job().hold(false);
  const auto motion = live_request(mesh_);
  if (!motion) return;
  const MoveCommand wanted = jobs_.move_command(*motion);
  // What has converged under the mouse needs no second run, unless other steps were asked for.
  if (wanted.how.increments <= 1 && mesh_.job().converged())
    mesh_.job().rename(wanted);
  else
    mesh_.job().retarget(wanted);
}

/// The command that the drag has shown is carried out from the mesh on screen, so that it is done
/// after an iteration or two.
void Motions::end_body_drag() {
  BodyDrag& drag = mesh_.drag();
  // What the handle said while it was held: this far and no further.
  const bool limit = drag.reach() == BodyDrag::Reach::limit;
  const RigidMotionRequest motion = limit ? drag.frame().motion : drag.wanted();
  const DragGrip grip = drag.grip();
  const std::string error = drag.error();
  std::optional<Coordinates> start = drag.coordinates();
  std::string cut_short;
  if (limit) cut_short = end_of_drag(drag);
  drag.end();
  base_.reset();
  start_.reset();
  mesh_.changed();
  // Nothing was done, and what was to be said of the mesh is to be said still.
  if (stays(motion)) {
    messages_.set_banner_of_position();
    if (!error.empty()) messages_.report_error("The mesh cannot follow this motion", error);
    return;
  }
  const MotionOptions& how = jobs_.motion_options();
  if (how.increments > 1) start.reset();
  const SmoothOptions smooth = jobs_.smooth_for_motion(grip.markers);
  Command command = in_space(mesh_)
                        ? drag_command(grip, motion.in_space(Vec3(0, 0, 0)), how, smooth)
                        : drag_command(grip, motion.about(Vec2(0, 0)), how, smooth);
  jobs_.start(std::move(command), false, std::move(start), std::move(cut_short));
}

void Motions::cancel_drag() {
  if (!std::exchange(mesh_.held().body, false)) return;
  const std::optional<RigidMotionRequest> base = std::exchange(base_, std::nullopt);
  if (mesh_.body_drag()) {
    mesh_.drag().end();
    mesh_.changed();
    messages_.set_banner_of_position();
    // The job that the drag had taken over goes on to where it was going.
    if (base) jobs_.start(jobs_.move_command(*base), false, std::exchange(start_, std::nullopt));
  } else if (base) {
    mesh_.job().hold(false);
    mesh_.job().retarget(jobs_.move_command(*base));
  } else {
    mesh_.job().hold(false);
    jobs_.stop();
  }
  messages_.tell(Notice::Kind::information, "Drag cancelled");
}

}  // namespace winslow::gui
