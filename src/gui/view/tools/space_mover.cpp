#include "gui/view/tools/space_mover.h"

#include <array>

namespace winslow::gui {

namespace {

/// Of what would be moved: where it is on screen now, and its directions.
struct Place {
  Vec3 point;
  GizmoFrame frame;
  bool turns = true;
};

std::optional<Place> place_of(const Session& session) {
  if (session.kind() != MeshKind::volume) return std::nullopt;
  const Selection& selection = session.selection();
  if (selection.shape_edit().active) {
    const auto* held = selection.space().held(selection.shape_edit());
    // What is being carried out is where the mesh says, not where it was held.
    if (!held || session.job().active()) return std::nullopt;
    Place place{held->centre, GizmoFrame::about(held->normal, "normal"), false};
    if (const BodyDrag* drag = session.mesh().work().body_drag(); drag && !drag->grip().rigid())
      place.point += drag->wanted().translate;
    return place;
  }
  if (selection.empty()) return std::nullopt;
  return Place{selection.space_pivot(), GizmoFrame::about(selection.space().axis()), true};
}

}  // namespace

std::optional<SpaceGizmo> SpaceMover::gizmo(const Session& session, const View& view,
                                            double scale) const {
  const auto place = place_of(session);
  if (!place || session.selection().space().pick()) return std::nullopt;
  return make_space_gizmo(view, place->point, dragging_ ? frame_ : place->frame, place->turns,
                          scale);
}

void SpaceMover::hover(const PointerState& p, const Session& session, const View& view,
                       double scale) {
  hovered_ = {};
  if (!p.over) return;
  if (const auto shown = gizmo(session, view, scale)) hovered_ = shown->at(p.position);
}

bool SpaceMover::press(const PointerState& p, const Session& session, const View& view,
                       double scale, ActionQueue& actions) {
  const auto shown = hovered_ ? gizmo(session, view, scale) : std::nullopt;
  if (!shown) return false;
  begin(hovered_, *shown, p.position, session, view, actions);
  return true;
}

void SpaceMover::take(const Vec3& point, const ScreenPoint& from, const Session& session,
                      const View& view, double scale, ActionQueue& actions) {
  const auto shown = make_space_gizmo(view, point, GizmoFrame(), false, scale);
  if (shown) begin({SpaceHandle::Kind::centre, 0}, *shown, from, session, view, actions);
}

void SpaceMover::begin(const SpaceHandle& handle, const SpaceGizmo& gizmo, const ScreenPoint& from,
                       const Session& session, const View& view, ActionQueue& actions) {
  dragging_ = true;
  typed_.clear();
  frame_ = gizmo.frame;
  gesture_.begin(handle, from, gizmo, view);
  actions.emplace_back(action::BeginDrag{session.selection().shape_edit().active});
}

void SpaceMover::follow(const PointerState& p, const PointerState& before, const View& view,
                        ActionQueue& actions) {
  const std::array<bool, 3> now{p.key_x, p.key_y, p.key_z};
  const std::array<bool, 3> was{before.key_x, before.key_y, before.key_z};
  for (int k = 0; k < 3; ++k)
    if (now[at(k)] && !was[at(k)]) gesture_.toggle_axis(k, view);
  // Before Enter counts, which may have come in the same frame.
  if (take_typed(p, before, view)) actions.emplace_back(action::DragTo{gesture_.motion()});
  if (p.cancel || (p.accept && !before.accept)) return end(p.cancel, actions);
  if (!typed_.active() && gesture_.follow(p.position, {p.shift, p.control}, view))
    actions.emplace_back(action::DragTo{gesture_.motion()});
  if (!p.left) end(false, actions);
}

bool SpaceMover::take_typed(const PointerState& p, const PointerState& before, const View& view) {
  const bool was_active = typed_.active();
  bool changed = typed_.type(p.text);
  if (p.erase && !before.erase) changed |= typed_.erase();
  if (p.next && !before.next) typed_.next(gesture_.typed_fields());
  // An axis may have been chosen since.
  if (typed_.active()) return gesture_.type(typed_);
  // Without numbers the mouse counts again, from where it is.
  return changed && was_active && gesture_.follow(p.position, {p.shift, p.control}, view);
}

void SpaceMover::end(bool cancelled, ActionQueue& actions) {
  dragging_ = false;
  if (cancelled)
    actions.emplace_back(action::CancelDrag{});
  else
    actions.emplace_back(action::EndDrag{});
}

}  // namespace winslow::gui
