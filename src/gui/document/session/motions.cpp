#include "gui/document/session/motions.h"

#include "core/error.h"
#include "core/mesh/topology.h"
#include "core/motion/rigid_motion.h"
#include "core/strategy/sliding.h"
#include "core/vcv/sphere/node_vcv.h"
#include "gui/document/jobs/body_drag.h"
#include "io/tables/table_files.h"

namespace winslow::gui {

namespace {

constexpr const char* at_work =
    "The solver is at work on something else. Wait until it is done, or cancel it.";

}  // namespace

void Motions::on(const action::ApplyMotion& a) {
  if (!mesh_.document() || selection_.empty() || work_.held().body) return;
  if (!jobs_.can_join(selection_.names())) {
    jobs_.start(move_command(a.motion), false);
  } else {
    work_.job().retarget(move_command(compose(*mesh_.live_motion(), resolved(a.motion))));
  }
}

/// The motion resolved for the open mesh, about the selection's pivot unless it has its own.
RigidMotion Motions::resolved(const RigidMotion& motion) const {
  return resolve_motion(motion, mesh_.coordinates().dimension(), selection_.space_pivot());
}

void Motions::on(const action::ApplyDeformation& a) {
  if (!mesh_.document() || selection_.empty() || work_.held().body) return;
  selection_.drop_preview();
  jobs_.start(DeformCommand{selection_.names(), a.shape, settings_.motion_options(),
                            settings_.smooth_for_motion(selection_.names())},
              false);
}

void Motions::on(const action::ApplyBodyPlan&) {
  if (!mesh_.document() || !selection_.plan().moves() || work_.held().body) return;
  selection_.drop_preview();
  if (jobs_.start(settings_.move_together(selection_.plan().bodies()), false))
    selection_.begin_plan();
}

void Motions::on(const action::MoveNodesOfFile& a) {
  if (!mesh_.document() || work_.held().body || reader_.busy()) return;
  reader_.start([a] {
    ReadTable read{a.file.filename().string(), {}, {}};
    read.error = error_of([&] {
      if (a.positions)
        read.shape = io::read_positions(a.file);
      else
        read.shape = io::read_displacements(a.file);
    });
    return read;
  });
}

bool Motions::poll() {
  const std::optional<ReadTable> read = reader_.poll();
  if (!read) return false;
  if (!read->error.empty())
    messages_.report_error("Cannot read " + read->name, read->error);
  else if (mesh_.document() && !work_.held().body)
    move_nodes(read->shape);
  return true;
}

/// Names no markers: the table says what moves. The markers that it moves do not slide.
void Motions::move_nodes(const decltype(DeformCommand::shape)& table) {
  const Mesh& mesh = std::as_const(mesh_).document()->state().mesh;
  std::vector<std::string> moving;
  try {
    const auto motion = std::visit(
        [&](const auto& shape) { return make_motion(*mesh.topology, mesh.coordinates, {}, shape); },
        table);
    moving = markers_moved_by(*mesh.topology, motion->nodes());
  } catch (const UsageError& error) {
    return messages_.report_error("These nodes cannot be moved", error.what());
  }
  selection_.drop_preview();
  jobs_.start(
      DeformCommand{{}, table, settings_.motion_options(), settings_.smooth_for_motion(moving)},
      false);
}

void Motions::on(const action::SetShapeEdit& a) {
  const bool dragging = work_.held().body;
  if (!mesh_.document() || (dragging && !a.active)) return;
  selection_.edit_shape(a.active, a.radius);
  const BodyDrag* drag = work_.body_drag();
  if (!dragging || !drag || drag->grip().rigid() || !selection_.shape_edit().holds()) return;
  // Restart the drag with the same motion for another part of the boundary.
  const RigidMotion pull = drag->wanted();
  begin_body_drag(shape_grip());
  work_.drag().to(pull);
  mesh_.changed();
}

DragGrip Motions::shape_grip() const {
  const ShapeEdit& edit = selection_.shape_edit();
  const Mesh& mesh = std::as_const(mesh_).document()->state().mesh;
  if (const auto* held = selection_.space().held(edit)) return held->grip;
  return grip_of(*edit.arc, edit.radius, *mesh_.boundary(), *mesh.topology, mesh.coordinates);
}

void Motions::on(const action::BeginDrag& a) {
  if (!mesh_.document() || work_.held().body) return;
  const bool rigid = !a.shape;
  if (rigid ? selection_.empty() : !selection_.shape_edit().holds()) return;
  base_.reset();
  start_.reset();
  if (work_.job().active()) {
    if (!rigid || !jobs_.can_join(selection_.names()))
      return messages_.tell(Notice::Kind::warning, at_work);
    base_ = mesh_.live_motion();
  }
  // In the direct mode the boundary moves in one step, and intermediate meshes may be tangled.
  const bool direct = rigid && settings_.motion_options().increments == 1;
  DragGrip grip = rigid ? DragGrip{selection_.names(), {}, {}} : shape_grip();
  if (!direct && begin_body_drag(std::move(grip))) {
    work_.held().body = true;
    return;
  }
  if (!rigid)
    return messages_.tell(Notice::Kind::warning,
                          "A tangled mesh cannot follow a change of shape. Smooth it first.");
  if (work_.job().active()) work_.job().hold(true);
  work_.held().body = true;
}

/// False if the drag cannot show valid meshes: its initial mesh is tangled, or the settings are
/// invalid (then the job reports this).
bool Motions::begin_body_drag(DragGrip grip) {
  std::optional<DragSession::Start> start;
  if (base_) start = DragSession::Start{work_.job().coordinates(), *base_};
  try {
    const SmoothOptions smooth = settings_.smooth_for_motion(grip.markers);
    work_.begin_drag(mesh_.motion_base(), std::move(grip), smooth, start, settings_.resolver());
  } catch (const UsageError&) {
    return false;
  }
  if (start) start_ = std::move(start->coordinates);
  if (work_.job().active()) work_.job().cancel();
  messages_.clear_banner();
  mesh_.changed();
  return true;
}

void Motions::on(const action::DragTo& a) {
  if (!work_.held().body) return;
  const RigidMotion motion = resolved(a.motion), total = base_ ? compose(*base_, motion) : motion;
  if (work_.body_drag()) {
    work_.drag().to(total);
    return mesh_.changed();
  }
  MoveCommand command = move_command(total);
  // The chosen number of steps applies to the final position; during the drag the body moves in one
  // step.
  command.how.increments = settings_.motion_options().increments == 0 ? 0 : 1;
  if (work_.job().active()) {
    work_.job().retarget(command);
    return;
  }
  if (!jobs_.start(command, false)) {
    work_.held().body = false;
    return;
  }
  work_.job().hold(true);
}

void Motions::on(const action::EndDrag&) {
  if (!std::exchange(work_.held().body, false)) return;
  if (work_.body_drag()) return end_body_drag();
  base_.reset();
  work_.job().hold(false);
  const auto motion = mesh_.live_motion();
  if (!motion) return;
  if (!moves(*motion)) return jobs_.stop();  // back at the start: the mesh as it was
  const MoveCommand wanted = move_command(*motion);
  // A job that converged during the drag needs no second run, unless several steps are set.
  if (wanted.how.increments <= 1 && work_.job().converged())
    work_.job().rename(wanted);
  else
    work_.job().retarget(wanted);
}

/// Carries out the command of the drag, starting from the mesh on screen, so that it needs only one
/// or two iterations.
void Motions::end_body_drag() {
  BodyDrag& drag = work_.drag();
  // At its limit the drag ends at the reached motion, as the handle showed.
  const bool limit = drag.reach() == BodyDrag::Reach::limit;
  const RigidMotion motion = limit ? drag.frame().motion : drag.wanted();
  const DragGrip grip = drag.grip();
  const std::string error = drag.error();
  std::optional<Coordinates> start = drag.coordinates();
  std::string cut_short;
  if (limit) cut_short = end_of_drag(drag);
  drag.end();
  base_.reset();
  start_.reset();
  mesh_.changed();
  // Nothing was changed: restore the banner of the present mesh.
  if (!moves(motion)) {
    messages_.set_banner_of_position();
    if (!error.empty()) messages_.report_error("The mesh cannot follow this motion", error);
    return;
  }
  const MotionOptions& how = settings_.motion_options();
  if (how.increments > 1) start.reset();
  const SmoothOptions smooth = settings_.smooth_for_motion(grip.markers);
  jobs_.start(drag_command(grip, motion, how, smooth), false, std::move(start),
              std::move(cut_short));
}

void Motions::cancel_drag() {
  if (!std::exchange(work_.held().body, false)) return;
  const std::optional<RigidMotion> base = std::exchange(base_, std::nullopt);
  if (work_.body_drag()) {
    work_.drag().end();
    mesh_.changed();
    messages_.set_banner_of_position();
    // Resume the job that the drag had taken over, with its target.
    if (base) jobs_.start(move_command(*base), false, std::exchange(start_, std::nullopt));
  } else if (base) {
    work_.job().hold(false);
    work_.job().retarget(move_command(*base));
  } else {
    work_.job().hold(false);
    jobs_.stop();
  }
  messages_.tell(Notice::Kind::information, "Drag cancelled");
}

void VcvEditor::on(const action::EditVcvs& a) {
  if (!mesh_.document() || a.edits.empty()) return;
  const MeshState& state = mesh_.document()->state();
  OngoingWork::EditedVcvs edited;
  try {
    if (state.mesh.topology->kind() == MeshKind::volume)
      edited.sphere = edit_vcvs(*state.mesh.topology, state.vcvs.by_hand().get(), a.edits);
    else
      edited.plane = edit_vcvs(*state.vcvs.plane(), a.edits);
  } catch (const UsageError& error) {
    return messages_.report_error("This is no virtual control volume", error.what());
  }
  EditVcvCommand command{a.edits, settings_.smooth_in_place()};
  if (work_.held().vcv && work_.job().active()) {
    work_.set_edited_vcvs(std::move(edited));
    work_.job().retarget(std::move(command));
    return mesh_.changed();
  }
  if (!jobs_.start(std::move(command), false)) return;
  work_.set_edited_vcvs(std::move(edited));
  work_.held().vcv = a.under_mouse;
  work_.job().hold(a.under_mouse);
}

void VcvEditor::on(const action::EndVcvEdit&) {
  if (!std::exchange(work_.held().vcv, false)) return;
  work_.job().hold(false);
}

void VcvEditor::on(const action::CancelVcvEdit&) {
  if (!work_.held().vcv) return;
  work_.job().hold(false);
  jobs_.stop();
  messages_.tell(Notice::Kind::information, "Edit cancelled");
}

}  // namespace winslow::gui
