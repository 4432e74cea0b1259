#include "gui/view/overlays/overlay.h"

#include "core/layers/layer_stack.h"
#include "gui/base/text.h"
#include "gui/view/overlays/tool_overlay.h"
#include "gui/view/overlays/vcv_overlay.h"
#include "gui/widgets/controls.h"

namespace winslow::gui {

namespace {

ImVec2 projected(const Overlay& o, const Vec3& point) {
  return static_cast<ImVec2>(o.view.project(point).at);
}

using Outline = std::vector<std::pair<Vec3, Vec3>>;

/// Draws planned edges. The few of a plane mesh have a halo, so that they are legible over any
/// colour; the many of a surface would merge into a blot.
void draw_planned(ImDrawList& list, const Overlay& o, const Outline& outline) {
  const auto draw = [&](ImU32 color, float width) {
    for (const auto& [a, b] : outline)
      list.AddLine(projected(o, a), projected(o, b), color, o.theme.px(width));
  };
  if (o.session.in_space()) return draw(faded(palette().accent, 0.65f), 1.2f);
  draw(faded(palette().card, 0.85f), 4.5f);
  draw(palette().accent, 1.8f);
}

/// Draws a line that is legible over any colour.
void draw_bold_line(ImDrawList& list, const Overlay& o, const Vec3& a, const Vec3& b, float width) {
  list.AddLine(projected(o, a), projected(o, b), faded(palette().card, 0.85f),
               o.theme.px(width + 3));
  list.AddLine(projected(o, a), projected(o, b), palette().accent, o.theme.px(width));
}

void draw_bold_node(ImDrawList& list, const Overlay& o, const Vec3& point) {
  const ImVec2 at = projected(o, point);
  list.AddCircle(at, o.theme.px(7), palette().card, 24, o.theme.px(4.5f));
  list.AddCircle(at, o.theme.px(7), palette().accent, 24, o.theme.px(2));
}

/// Draws a dot with a rim. share: from 1, the node follows the mouse in full, to 0, it stays.
void draw_held_dot(ImDrawList& list, const Overlay& o, const Vec3& point, float share) {
  const ImVec2 at = projected(o, point);
  list.AddCircleFilled(at, o.theme.px(2.0f + 3.0f * share), palette().card, 16);
  list.AddCircleFilled(at, o.theme.px(1.0f + 3.0f * share),
                       faded(palette().accent, 0.35f + 0.65f * share), 16);
}

/// From where it is seen to where it leaves the view.
void draw_dashed(ImDrawList& list, const Overlay& o, const Vec3& point, const Vec3& axis,
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

/// Draws the axis of a pivot, and the items that define it.
void draw_pivot_line(ImDrawList& list, const Overlay& o, const SpacePivot& pivot,
                     const Coordinates& x) {
  const double unit = o.view.pixel_size(pivot.point);
  double half = static_cast<double>(o.theme.px(150)) * unit;
  std::vector<Vec3> source;
  for (const Index node : pivot.nodes) source.push_back(place_of(x, node));
  if (source.size() == 2) half = std::max(half, 0.6 * (source[1] - source[0]).norm());
  if (pivot.nodes.size() != 1) draw_dashed(list, o, pivot.point, pivot.axis.normalized(), half);
  if (source.size() == 1) draw_bold_node(list, o, source[0]);
  for (std::size_t k = 0; k < source.size() && source.size() > 1; ++k)
    if (source.size() > 2 || k == 0)
      draw_bold_line(list, o, source[k], source[(k + 1) % source.size()], 2.4f);
}

/// Draws the pivot of the selection, if the user chose one.
void draw_chosen_pivot(ImDrawList& list, const Overlay& o) {
  const Selection& selection = o.session.selection();
  if (selection.empty() || selection.shape_edit().active) return;
  SpacePivot pivot = selection.space().source();
  if (pivot.from == PivotFrom::centre && !GizmoFrame::about(pivot.axis).aligned) return;
  pivot.point = selection.space_pivot();
  pivot.axis = selection.space().axis();
  // The nodes of a body move with it and are visible in the mesh; in a drag only the line matters.
  if (o.session.in_motion()) pivot.nodes.clear();
  draw_pivot_line(list, o, pivot, o.session.coordinates());
  ui::note("pivot/line", {projected(o, pivot.point).x - 4, projected(o, pivot.point).y - 4},
           {projected(o, pivot.point).x + 4, projected(o, pivot.point).y + 4});
}

void draw_offered_pivot(ImDrawList& list, const Overlay& o) {
  const auto& pick = o.session.selection().space().pick();
  if (!pick) return;
  const Coordinates& x = o.session.coordinates();
  if (pick->first) draw_bold_node(list, o, place_of(x, *pick->first));
  const auto& source = o.viewport.picker().pivot_source();
  if (!source) return;
  const auto pivot = pivot_at(*source, x, Vec3::UnitZ());
  if (pivot) draw_pivot_line(list, o, *pivot, x);
}

/// Draws where the mouse puts the body or the part of the boundary: the mesh may be a step behind.
/// In space only until the mesh has arrived, as the outline would hide it.
void draw_wanted(ImDrawList& list, const Overlay& o) {
  const BodyDrag* drag = o.session.mesh().work().body_drag();
  if (o.session.in_space() && (!drag || drag->reach() == BodyDrag::Reach::there)) return;
  const Coordinates& rest = o.session.mesh().motion_base().mesh.coordinates;
  if (const auto motion = o.session.mesh().live_motion()) {
    Outline outline;
    for (const auto& [a, b] : o.session.selection().own().outline())
      outline.emplace_back(transform(*motion, place_of(rest, a)),
                           transform(*motion, place_of(rest, b)));
    return draw_planned(list, o, outline);
  }
  if (!drag) return;
  const DragGrip& grip = drag->grip();
  const Vec3 pull = drag->wanted().translate;
  for (std::size_t i = 0; i < grip.nodes.size(); ++i)
    draw_held_dot(list, o, place_of(rest, grip.nodes[i]) + grip.shares[i] * pull, 0.6f);
}

/// While shapes are edited, draws the nodes of a plane mesh that can be grabbed: all of them if
/// they are few, else those around the mouse.
void draw_boundary_nodes(ImDrawList& list, const Overlay& o) {
  const BoundaryIndex* boundary = o.session.mesh().boundary();
  if (!boundary) return;
  const ScreenBox seen = o.view.viewport();
  const ScreenPoint mouse(ImGui::GetIO().MousePos);
  const auto reach = static_cast<double>(o.theme.px(130));
  constexpr std::size_t few = 400;
  std::vector<ScreenPoint> all, near;
  for (const auto& body : boundary->bodies()) {
    for (const Index node : body.nodes) {
      const ScreenPoint at = o.view.project(place_of(o.session.coordinates(), node)).at;
      if (!seen.contains(at)) continue;
      all.push_back(at);
      if ((at - mouse).norm() < reach) near.push_back(at);
    }
  }
  const auto& shown = all.size() <= few ? all : near;
  for (const ScreenPoint& at : shown) {
    list.AddCircleFilled(static_cast<ImVec2>(at), o.theme.px(3.4f), palette().card, 12);
    list.AddCircleFilled(static_cast<ImVec2>(at), o.theme.px(2.4f), palette().accent, 12);
  }
  if (!shown.empty())
    ui::note("shape/nodes/" + std::to_string(shown.size()), static_cast<ImVec2>(seen.min),
             static_cast<ImVec2>(seen.max));
}

/// The nodes that a drag of the boundary moves; empty: nothing is held.
DragGrip held_grip(const Session& session) {
  const ShapeEdit& edit = session.selection().shape_edit();
  if (const BodyDrag* drag = session.mesh().work().body_drag()) return drag->grip();
  if (const auto* held = session.selection().space().held(edit)) return held->grip;
  const BoundaryIndex* boundary = session.mesh().boundary();
  if (!edit.arc || !boundary) return {};
  return grip_of(*edit.arc, edit.radius, *boundary, *session.topology(), session.coordinates());
}

/// Draws the held nodes of the boundary, larger the more a drag moves them, and what a click would
/// hold.
void draw_held(ImDrawList& list, const Overlay& o) {
  if (!o.session.selection().shape_edit().active) return;
  const Coordinates& x = o.session.coordinates();
  draw_boundary_nodes(list, o);
  const DragGrip grip = held_grip(o.session);
  for (std::size_t i = 0; i < grip.shares.size(); ++i)
    draw_held_dot(list, o, place_of(x, grip.nodes[i]), static_cast<float>(grip.shares[i]));
  if (!grip.nodes.empty() && !o.session.mesh().boundary())
    ui::note("shape/nodes/" + std::to_string(grip.nodes.size()),
             static_cast<ImVec2>(o.view.viewport().min),
             static_cast<ImVec2>(o.view.viewport().max));
  const auto& offered = o.viewport.picker().held();
  if (std::ranges::any_of(offered, [&](Index node) { return node >= x.size(); })) return;
  if (offered.size() == 1) draw_bold_node(list, o, place_of(x, offered[0]));
  for (std::size_t k = 0; k < offered.size() && offered.size() > 1; ++k)
    draw_bold_line(list, o, place_of(x, offered[k]), place_of(x, offered[(k + 1) % offered.size()]),
                   1.8f);
}

std::string pick_hint(const action::PickPivot& pick, const std::optional<PivotSource>& source) {
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

std::string hint_text(const Overlay& o) {
  const Viewport& viewport = o.viewport;
  if (viewport.gesture() == Viewport::Gesture::pivot) {
    const std::string& snapped = viewport.snapped_to();
    return snapped.empty() ? "Pivot; Ctrl snaps" : "Pivot: " + snapped;
  }
  if (viewport.gesture() != Viewport::Gesture::none || !viewport.over()) return {};
  const Handle handle = viewport.mover().handle();
  const auto gizmo = handle ? viewport.mover().gizmo(o.scene, o.view) : std::nullopt;
  if (gizmo) return handle_hint(handle, gizmo->place);
  if (const auto& pick = o.session.selection().space().pick())
    return pick_hint(*pick, viewport.picker().pivot_source());
  const auto& offered = viewport.picker().held();
  if (offered.empty()) return {};
  if (offered.size() > 1) return "Click holds this face, Shift+click takes it as well";
  return "Node " + std::to_string(offered[0]) + ": drag it; Shift+click takes " +
         (o.session.mesh().boundary() ? "the arc up to it" : "it as well");
}

/// Rings around the node that is inspected and the one under the mouse.
void draw_rings(ImDrawList& list, const Overlay& o) {
  const NodeSelection& nodes = o.session.nodes();
  const auto ring = [&](const std::optional<Index>& node, float radius, float width) {
    if (!node || *node >= o.session.coordinates().size()) return;
    draw_node_ring(list, projected(o, place_of(o.session.coordinates(), *node)), o.theme.px(radius),
                   o.theme.px(width), palette().accent);
  };
  ring(nodes.inspected(), 6, 2);
  ring(nodes.hovered(), 8, 1.5f);
}

void draw_cut_handle(ImDrawList& list, const Overlay& o) {
  const CutPlane* cut = held_cut(o.scene);
  if (!cut) return;
  const CutPart hot = o.viewport.cut_part();
  const CutHandle handle = make_cut_handle(*cut, o.view, static_cast<double>(o.theme.scale));
  const ImVec2 foot = static_cast<ImVec2>(handle.foot), tip = static_cast<ImVec2>(handle.tip);
  const ImU32 calm = palette().text, lit = palette().accent;
  const ImU32 shaft = hot == CutPart::shaft ? lit : calm, knob = hot == CutPart::knob ? lit : calm;
  list.AddLine(foot, tip, palette().card, o.theme.px(6));
  list.AddCircleFilled(foot, o.theme.px(9.5f), palette().card, 32);
  list.AddCircleFilled(tip, o.theme.px(8.5f), palette().card, 32);
  list.AddLine(foot, tip, shaft, o.theme.px(2.5f));
  list.AddCircle(foot, o.theme.px(7.5f), shaft, 32, o.theme.px(2.5f));
  list.AddCircleFilled(tip, o.theme.px(6), knob, 32);
  ui::note("cut/foot", {foot.x - 4, foot.y - 4}, {foot.x + 4, foot.y + 4});
  ui::note("cut/tip", {tip.x - 4, tip.y - 4}, {tip.x + 4, tip.y + 4});
}

}  // namespace

void draw_overlay(ImDrawList& list, const Overlay& o) {
  const Selection& selection = o.session.selection();
  draw_rings(list, o);
  draw_region(list, o.session, o.view, o.theme);
  if (o.session.dragging()) draw_wanted(list, o);
  if (const auto& shape = selection.deformation_preview()) draw_planned(list, o, shape->outline);
  if (const auto& motion = selection.motion_preview()) draw_planned(list, o, motion->outline);
  draw_planned(list, o, selection.plan().outline());
  draw_layer_preview(list, o);
  draw_held(list, o);
  draw_chosen_pivot(list, o);
  draw_offered_pivot(list, o);
}

void draw_handles(ImDrawList& list, const Overlay& o) {
  const Mover& mover = o.viewport.mover();
  if (const auto gizmo = mover.gizmo(o.scene, o.view))
    draw_gizmo(list, o.view, o.theme, *gizmo, mover);
  draw_cut_handle(list, o);
  if (const auto centre = o.viewport.orbit_centre()) {
    const ImVec2 at = projected(o, *centre);
    list.AddCircleFilled(at, o.theme.px(5), palette().card, 24);
    list.AddCircleFilled(at, o.theme.px(3.2f), palette().accent, 24);
  }
}

void draw_mouse_labels(ImDrawList& list, const Overlay& o) {
  if (o.session.dragging() && o.viewport.dragging())
    return draw_beside_mouse(list, o.view, o.theme,
                             drag_labels(motion_text(o.viewport.mover(), o.view), o.session));
  if (std::string hint = hint_text(o); !hint.empty())
    draw_beside_mouse(list, o.view, o.theme, {{std::move(hint), palette().text}});
}

namespace {

/// Nodes of a planned column, the wall's first.
std::vector<ScreenPoint> points_of(const LayerColumn& column, const Coordinates& x,
                                   const View& view) {
  Vec2 at = x.xy(column.wall_node);
  std::vector<ScreenPoint> points{view.to_screen(at)};
  for (std::size_t k = 0; k < column.count(); ++k) {
    at += wanted_length(column, k) * column.plane_direction();
    points.push_back(view.to_screen(at));
  }
  return points;
}

/// Draws the outlines of layers that are distinguishable on screen, and the last one.
void draw_outlines(ImDrawList& list, const Overlay& o, const std::vector<ScreenPoint>& a,
                   const std::vector<ScreenPoint>& b) {
  constexpr double apart = 2.5;  // pixels
  const std::size_t top = std::max(a.size(), b.size());
  ScreenPoint last = a.front();
  for (std::size_t k = 1; k < top; ++k) {
    const ScreenPoint from = a[std::min(k, a.size() - 1)];
    const ScreenPoint to = b[std::min(k, b.size() - 1)];
    if (k + 1 < top && (from - last).norm() < apart) continue;
    last = from;
    list.AddLine(ImVec2(from), ImVec2(to), faded(palette().accent, 0.7f), o.theme.px(1));
  }
}

void draw_reason(ImDrawList& list, const Overlay& o, const LayerColumn& column) {
  const std::string text = short_number(column.thickness()) + " of " + short_number(column.asked) +
                           " thick: " + std::string(limit_name(column.limit));
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  const ImVec2 at(mouse.x + o.theme.px(18), mouse.y + o.theme.px(14));
  const ImVec2 size = ImGui::CalcTextSize(text.c_str());
  const float pad = o.theme.px(7);
  list.AddRectFilled(at, ImVec2(at.x + size.x + 2 * pad, at.y + size.y + 1.4f * pad),
                     faded(palette().warning, 0.88f), o.theme.px(5));
  list.AddText(ImVec2(at.x + pad, at.y + 0.7f * pad), palette().card, text.c_str());
}

}  // namespace

void draw_layer_preview(ImDrawList& list, const Overlay& o) {
  const LayerStack* plan = o.session.layers().preview().plan();
  if (!plan || o.session.in_motion()) return;
  const Coordinates& x = o.session.layers().preview().coordinates();
  const ScreenPoint pointer(ImGui::GetIO().MousePos);
  double nearest = static_cast<double>(o.theme.px(6));
  const LayerColumn* pointed = nullptr;
  std::vector<std::vector<ScreenPoint>> columns;
  columns.reserve(plan->columns.size());
  for (const LayerColumn& column : plan->columns) {
    columns.push_back(points_of(column, x, o.view));
    const auto& points = columns.back();
    const bool cut = cut_short(column);
    list.AddLine(ImVec2(points.front()), ImVec2(points.back()),
                 cut ? palette().warning : palette().accent, o.theme.px(cut ? 2.0f : 1.0f));
    if (cut && points.size() == 1)
      list.AddCircleFilled(ImVec2(points.front()), o.theme.px(3), palette().warning);
    const double away = distance_to_segment(pointer, points.front(), points.back());
    if (!cut || away > nearest) continue;
    nearest = away;
    pointed = &column;
  }
  // Drawn beneath the outlines, which are too close together for halos of their own.
  for (const ColumnPair& pair : plan->pairs)
    list.AddLine(ImVec2(columns[pair.left].back()), ImVec2(columns[pair.right].back()),
                 faded(palette().card, 0.85f), o.theme.px(4));
  for (const ColumnPair& pair : plan->pairs)
    draw_outlines(list, o, columns[pair.left], columns[pair.right]);
  if (pointed) draw_reason(list, o, *pointed);
}

}  // namespace winslow::gui
