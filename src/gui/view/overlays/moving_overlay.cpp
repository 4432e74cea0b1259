#include "gui/view/overlays/moving_overlay.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "core/motion/rigid_motion.h"
#include "gui/view/overlays/mouse_labels.h"
#include "gui/view/overlays/space_gizmo_drawing.h"
#include "gui/widgets/controls.h"

namespace winslow::gui {

namespace {

ImVec2 projected(const SpaceOverlay& o, const Vec3& point) {
  return static_cast<ImVec2>(o.view.project(point).at);
}

void draw_planned_edges(ImDrawList& list, const SpaceOverlay& o,
                        const std::vector<std::pair<Vec3, Vec3>>& outline) {
  for (const auto& [a, b] : outline)
    list.AddLine(projected(o, a), projected(o, b), faded(palette().accent, 0.65f),
                 o.theme.px(1.2f));
}

/// A line that is legible over any colour.
void draw_bold_line(ImDrawList& list, const SpaceOverlay& o, const Vec3& a, const Vec3& b,
                    float width) {
  list.AddLine(projected(o, a), projected(o, b), faded(palette().card, 0.85f),
               o.theme.px(width + 3));
  list.AddLine(projected(o, a), projected(o, b), palette().accent, o.theme.px(width));
}

void draw_bold_node(ImDrawList& list, const SpaceOverlay& o, const Vec3& point) {
  const ImVec2 at = projected(o, point);
  list.AddCircle(at, o.theme.px(7), palette().card, 24, o.theme.px(4.5f));
  list.AddCircle(at, o.theme.px(7), palette().accent, 24, o.theme.px(2));
}

/// From where it is seen to where it leaves the view.
void draw_dashed(ImDrawList& list, const SpaceOverlay& o, const Vec3& point, const Vec3& axis,
                 double half) {
  const ScreenPoint a = o.view.project(point - half * axis).at;
  const ScreenPoint b = o.view.project(point + half * axis).at;
  const double length = (b - a).norm();
  const double dash = static_cast<double>(o.theme.px(7));
  if (length < dash || length > 1e5) return;
  const ScreenVector unit = (b - a) / length;
  for (const auto& [color, width] :
       {std::pair{faded(palette().card, 0.8f), 3.6f}, std::pair{palette().accent, 1.6f}})
    for (double s = 0; s < length; s += 1.7 * dash)
      list.AddLine(static_cast<ImVec2>(a + s * unit),
                   static_cast<ImVec2>(a + std::min(s + dash, length) * unit), color,
                   o.theme.px(width));
}

/// The line about which a pivot turns, with what it was taken from.
void draw_pivot_line(ImDrawList& list, const SpaceOverlay& o, const SpacePivot& pivot,
                     const Coordinates& x) {
  const double unit = o.view.pixel_size(pivot.point);
  double half = static_cast<double>(o.theme.px(150)) * unit;
  std::vector<Vec3> source;
  for (const Index node : pivot.nodes) source.push_back(x.xyz(node));
  if (source.size() == 2) half = std::max(half, 0.6 * (source[1] - source[0]).norm());
  if (pivot.nodes.size() != 1) draw_dashed(list, o, pivot.point, pivot.axis.normalized(), half);
  if (source.size() == 1) draw_bold_node(list, o, source[0]);
  for (std::size_t k = 0; k < source.size() && source.size() > 1; ++k)
    if (source.size() > 2 || k == 0)
      draw_bold_line(list, o, source[k], source[(k + 1) % source.size()], 2.4f);
}

/// What the selection turns about, where that was chosen.
void draw_chosen_pivot(ImDrawList& list, const SpaceOverlay& o) {
  const Selection& selection = o.session.selection();
  if (selection.empty() || selection.shape_edit().active) return;
  SpacePivot pivot = selection.space().source();
  if (pivot.from == PivotFrom::centre && !GizmoFrame::about(pivot.axis).aligned) return;
  pivot.point = selection.space_pivot();
  pivot.axis = selection.space().axis();
  // The nodes of a body go with it, and are seen in the mesh; the line is what counts in a drag.
  if (o.session.in_motion()) pivot.nodes.clear();
  draw_pivot_line(list, o, pivot, o.session.coordinates());
  ui::note("pivot/line", {projected(o, pivot.point).x - 4, projected(o, pivot.point).y - 4},
           {projected(o, pivot.point).x + 4, projected(o, pivot.point).y + 4});
}

void draw_offered_pivot(ImDrawList& list, const SpaceOverlay& o, const SpaceViewport& viewport) {
  const auto& pick = o.session.selection().space().pick();
  if (!pick) return;
  const Coordinates& x = o.session.coordinates();
  if (pick->first) draw_bold_node(list, o, x.xyz(*pick->first));
  if (!viewport.pivot_source()) return;
  const auto pivot = pivot_at(*viewport.pivot_source(), x, Vec3::UnitZ());
  if (pivot) draw_pivot_line(list, o, *pivot, x);
}

/// Where the mouse wants the body, or the part of the boundary, as long as the mesh is behind.
void draw_wanted_in_space(ImDrawList& list, const SpaceOverlay& o) {
  const BodyDrag* drag = o.session.mesh().body_drag();
  if (!drag || drag->reach() == BodyDrag::Reach::there) return;
  const Coordinates& rest = o.session.mesh().motion_base().mesh.coordinates;
  if (const auto motion = live_space_motion(o.session.mesh())) {
    std::vector<std::pair<Vec3, Vec3>> outline;
    for (const auto& [a, b] : o.session.selection().space().outline())
      outline.emplace_back(transform(*motion, rest.xyz(a)), transform(*motion, rest.xyz(b)));
    return draw_planned_edges(list, o, outline);
  }
  const Vec3 pull = drag->wanted().in_space(Vec3(0, 0, 0)).translate;
  for (std::size_t i = 0; i < drag->grip().nodes.size(); ++i)
    list.AddCircleFilled(
        projected(o, rest.xyz(drag->grip().nodes[i]) + drag->grip().shares[i] * pull),
        o.theme.px(2.4f), palette().accent);
}

/// What is held of the boundary, the larger the more a drag moves it, and what a click would hold.
void draw_held(ImDrawList& list, const SpaceOverlay& o, const SpaceViewport& viewport) {
  const ShapeEdit& edit = o.session.selection().shape_edit();
  if (!edit.active) return;
  const Coordinates& x = o.session.coordinates();
  const BodyDrag* drag = o.session.mesh().body_drag();
  const auto* held = o.session.selection().space().held(edit);
  static const DragGrip none;
  const DragGrip& grip = drag ? drag->grip() : held ? held->grip : none;
  for (std::size_t i = 0; i < grip.nodes.size() && !grip.rigid(); ++i) {
    const ImVec2 at = projected(o, x.xyz(grip.nodes[i]));
    const auto share = static_cast<float>(grip.shares[i]);
    list.AddCircleFilled(at, o.theme.px(2.0f + 2.8f * share), palette().card, 16);
    list.AddCircleFilled(at, o.theme.px(1.0f + 2.8f * share),
                         faded(palette().accent, 0.35f + 0.65f * share), 16);
  }
  if (!grip.nodes.empty())
    ui::note("shape/nodes/" + std::to_string(grip.nodes.size()),
             static_cast<ImVec2>(o.view.viewport().min),
             static_cast<ImVec2>(o.view.viewport().max));
  if (drag) return;
  const auto& offered = viewport.held_by_click();
  if (offered.size() == 1) draw_bold_node(list, o, x.xyz(offered[0]));
  for (std::size_t k = 0; k < offered.size() && offered.size() > 1; ++k)
    draw_bold_line(list, o, x.xyz(offered[k]), x.xyz(offered[(k + 1) % offered.size()]), 1.8f);
}

std::string pick_hint(const action::PickPivot& pick, const SpaceViewport& viewport) {
  const auto& source = viewport.pivot_source();
  switch (pick.from.value_or(PivotFrom::node)) {
    case PivotFrom::edge:
      return source ? "Turn about this edge" : "Click an edge to turn about it";
    case PivotFrom::face:
      return source ? "Turn about this face's normal" : "Click a face to turn about its normal";
    case PivotFrom::nodes:
      if (!pick.first) return "Click the first of two nodes of the axis";
      return source && source->nodes.size() == 2 ? "Turn about the line to this node"
                                                 : "Click the other node of the axis";
    default:
      return source ? "Turn about this node" : "Click a node to turn about it";
  }
}

std::string hint_of(const SpaceOverlay& o, const SpaceViewport& viewport,
                    const std::optional<SpaceGizmo>& gizmo) {
  if (gizmo && viewport.mover().handle())
    return space_handle_hint(viewport.mover().handle(), gizmo->frame);
  if (const auto& pick = o.session.selection().space().pick()) return pick_hint(*pick, viewport);
  const auto& offered = viewport.held_by_click();
  if (offered.size() == 1)
    return "Node " + std::to_string(offered[0]) + ": drag it; Shift+click takes it as well";
  return offered.empty() ? "" : "Click holds this face, Shift+click takes it as well";
}

}  // namespace

void draw_moving(ImDrawList& list, const SpaceOverlay& o, const SpaceViewport& viewport) {
  const Selection& selection = o.session.selection();
  if (const auto& motion = selection.motion_preview()) draw_planned_edges(list, o, motion->outline);
  if (const auto& shape = selection.deformation_preview())
    draw_planned_edges(list, o, shape->outline);
  draw_wanted_in_space(list, o);
  draw_held(list, o, viewport);
  draw_chosen_pivot(list, o);
  draw_offered_pivot(list, o, viewport);
  const SpaceMover& mover = viewport.mover();
  const auto gizmo = mover.gizmo(o.session, o.view, static_cast<double>(o.theme.scale));
  if (gizmo) draw_space_gizmo(list, o.view, o.theme, *gizmo, mover);
  if (viewport.gesture() == SpaceViewport::Gesture::move) {
    draw_beside_mouse(list, o.view, o.theme,
                      drag_labels(space_motion_text(mover, o.view), o.session));
  } else if (viewport.gesture() == SpaceViewport::Gesture::none) {
    if (std::string hint = hint_of(o, viewport, gizmo); !hint.empty() && viewport.over())
      draw_beside_mouse(list, o.view, o.theme, {{std::move(hint), palette().text}});
  }
}

}  // namespace winslow::gui
