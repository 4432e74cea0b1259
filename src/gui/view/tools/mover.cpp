#include "gui/view/tools/mover.h"

#include "gui/document/session/session.h"

namespace winslow::gui {

namespace {

/// Place and directions of what would be moved.
std::optional<GizmoPlace> place_of(const ViewportScene& scene, const View& view) {
  const Session& session = scene.session;
  const Selection& selection = session.selection();
  const bool ready = session.document() && movable_meshes.contains(session.kind());
  if (!ready || scene.look_only || selection.space().pick()) return std::nullopt;
  if (!selection.shape_edit().active) {
    if (selection.empty()) return std::nullopt;
    return GizmoPlace{.pivot = selection.space_pivot(),
                      .frame = GizmoFrame::about(selection.space().axis()),
                      .in_plane = !view.turns(),
                      .reach = scene.reach};
  }
  // In a plane mesh, nodes are dragged without a handle.
  const auto* held = selection.space().held(selection.shape_edit());
  // During a job, the mesh determines the place, not the held nodes.
  if (!held || session.job().active()) return std::nullopt;
  GizmoPlace place{
      .pivot = held->centre, .frame = GizmoFrame::about(held->normal, "normal"), .turns = false};
  if (const BodyDrag* drag = session.mesh().work().body_drag(); drag && !drag->grip().rigid())
    place.pivot += drag->wanted().translate;
  return place;
}

}  // namespace

std::optional<Gizmo> Mover::gizmo(const ViewportScene& scene, const View& view) const {
  auto place = place_of(scene, view);
  if (!place) return std::nullopt;
  if (dragging_) {
    place->frame = frame_;
    place->turned = gesture_.rotate();
  }
  return make_gizmo(view, *place, scene.scale);
}

void Mover::hover(const PointerFrame& frame) {
  hovered_ = {};
  if (!frame.pointer.over) return;
  if (const auto shown = gizmo(frame.scene, frame.view))
    hovered_ = shown->handle_at(frame.pointer.position);
}

void Mover::grab(const Vec3& point, const ScreenPoint& from, const PointerFrame& frame) {
  const GizmoPlace place{.pivot = point, .turns = false, .in_plane = !frame.view.turns()};
  const auto shown = make_gizmo(frame.view, place, frame.scene.scale);
  if (shown) begin({Handle::Kind::centre, 0}, *shown, from, frame);
}

void Mover::begin(const Handle& handle, const Gizmo& gizmo, const ScreenPoint& from,
                  const PointerFrame& frame) {
  dragging_ = true;
  shape_ = frame.scene.session.selection().shape_edit().active;
  typed_.clear();
  frame_ = gizmo.frame();
  gesture_.begin(handle, from, gizmo, frame.view);
  frame.actions.emplace_back(action::BeginDrag{shape_});
}

void Mover::drag(const PointerFrame& frame, const PointerState& before) {
  const PointerState& p = frame.pointer;
  const std::array<bool, 3> now{p.key_x, p.key_y, p.key_z};
  const std::array<bool, 3> was{before.key_x, before.key_y, before.key_z};
  for (int k = 0; k < 3; ++k)
    if (now[at(k)] && !was[at(k)]) gesture_.toggle_axis(k, frame.view);
  // Typed numbers come before Enter, which may be pressed in the same frame.
  if (take_typed(frame, before)) frame.actions.emplace_back(action::DragTo{gesture_.motion()});
  if (p.cancel || (p.accept && !before.accept)) return end(p.cancel, frame.actions);
  if (!typed_.active() && gesture_.drag_to(p.position, {p.shift, p.control}, frame.view))
    frame.actions.emplace_back(action::DragTo{gesture_.motion()});
  if (!p.left) end(false, frame.actions);
}

bool Mover::take_typed(const PointerFrame& frame, const PointerState& before) {
  const PointerState& p = frame.pointer;
  const bool was_active = typed_.active();
  bool changed = typed_.type(p.text);
  if (p.erase && !before.erase) changed |= typed_.erase();
  if (p.next && !before.next) typed_.next(gesture_.typed_fields());
  // An axis may have been chosen in the meantime.
  if (typed_.active()) return gesture_.type(typed_);
  // Without numbers the mouse counts again, from its present place.
  return changed && was_active && gesture_.drag_to(p.position, {p.shift, p.control}, frame.view);
}

void Mover::end(bool cancelled, ActionQueue& actions) {
  dragging_ = false;
  if (cancelled)
    actions.emplace_back(action::CancelDrag{});
  else
    actions.emplace_back(action::EndDrag{});
}

}  // namespace winslow::gui
