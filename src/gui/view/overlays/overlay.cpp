#include "gui/view/overlays/overlay.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "core/inspect/nodal_view.h"
#include "core/layers/layer_measures.h"
#include "core/motion/rigid_motion.h"
#include "gui/base/text.h"
#include "gui/view/overlays/gizmo_drawing.h"
#include "gui/view/overlays/mouse_labels.h"
#include "gui/view/overlays/vcv_overlay.h"
#include "gui/view/overlays/view_overlay.h"
#include "gui/widgets/controls.h"

namespace winslow::gui {

namespace {

ImVec2 pixel(const ScreenPoint& p) { return static_cast<ImVec2>(p); }

/// Lines that are to be: with a halo, so that they are legible over any colour.
void draw_planned(ImDrawList& list, const Overlay& o,
                  const std::vector<std::array<Vec2, 2>>& edges) {
  for (const auto& [color, width] : {std::pair{faded(palette().card, 0.85f), o.theme.px(4.5f)},
                                     std::pair{palette().accent, o.theme.px(1.8f)}})
    for (const auto& [a, b] : edges)
      list.AddLine(pixel(o.view.to_screen(a)), pixel(o.view.to_screen(b)), color, width);
}

/// Boundary edges moved by whatever `place` says of their nodes.
template <class Place>
void draw_edges(ImDrawList& list, const Overlay& o, const std::vector<Index>& markers,
                const Place& place) {
  const Topology& topology = *o.session.mesh().motion_base().mesh.topology;
  std::vector<std::array<Vec2, 2>> edges;
  for (Index m : markers)
    for (const Face& edge : topology.markers()[static_cast<std::size_t>(m)].faces)
      edges.push_back({place(edge[0]), place(edge[1])});
  draw_planned(list, o, edges);
}

/// The body where the mouse wants it: the mesh may be a step behind.
void draw_wanted(ImDrawList& list, const Overlay& o) {
  const Coordinates& rest = o.session.mesh().motion_base().mesh.coordinates;
  if (const auto motion = o.session.mesh().live_motion())
    return draw_edges(list, o, o.session.selection().markers(),
                      [&](Index node) { return transform(*motion, rest.xy(node)); });
  const BodyDrag* drag = o.session.mesh().body_drag();
  if (!drag || drag->grip().rigid()) return;
  const auto& nodes = drag->grip().nodes;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const Vec2 at = rest.xy(nodes[i]) + drag->grip().shares[i] * drag->wanted().translate;
    const ImVec2 dot = pixel(o.view.to_screen(at));
    list.AddCircleFilled(dot, o.theme.px(4.0f), faded(palette().card, 0.85f));
    list.AddCircleFilled(dot, o.theme.px(2.5f), palette().accent);
  }
}

void draw_preview(ImDrawList& list, const Overlay& o) {
  const auto draw = [&](const std::vector<std::pair<Vec3, Vec3>>& outline) {
    std::vector<std::array<Vec2, 2>> edges;
    for (const auto& [a, b] : outline) edges.push_back({a.head<2>(), b.head<2>()});
    draw_planned(list, o, edges);
  };
  if (const auto& shape = o.session.selection().deformation_preview()) draw(shape->outline);
  if (const auto& motion = o.session.selection().motion_preview()) draw(motion->outline);
}

/// While shapes are edited: the nodes that can be taken, all of them where they are few, else those
/// around the mouse.
void draw_boundary_nodes(ImDrawList& list, const Overlay& o) {
  const Coordinates& x = o.session.coordinates();
  const ScreenBox seen = o.view.viewport();
  const ScreenPoint mouse(ImGui::GetIO().MousePos);
  const auto reach = static_cast<double>(o.theme.px(130));
  constexpr std::size_t few = 400;
  std::vector<ScreenPoint> all, near;
  for (const auto& body : o.scene.boundary->bodies()) {
    for (const Index node : body.nodes) {
      const ScreenPoint at = o.view.to_screen(x.xy(node));
      if (!seen.contains(at)) continue;
      all.push_back(at);
      if ((at - mouse).norm() < reach) near.push_back(at);
    }
  }
  const auto& shown = all.size() <= few ? all : near;
  for (const ScreenPoint& at : shown) {
    list.AddCircleFilled(pixel(at), o.theme.px(3.4f), palette().card, 12);
    list.AddCircleFilled(pixel(at), o.theme.px(2.4f), palette().accent, 12);
  }
  if (!shown.empty())
    ui::note("shape/nodes/" + std::to_string(shown.size()), pixel(seen.min), pixel(seen.max));
}

/// While shapes are edited: the held arc, how far a drag of it fades, the node under the mouse.
void draw_shape(ImDrawList& list, const Overlay& o) {
  const ShapeEdit& edit = o.scene.shape;
  const Coordinates& x = o.session.coordinates();
  if (edit.arc && !o.session.dragging()) {
    const DragGrip grip =
        grip_of(*edit.arc, edit.radius, *o.scene.boundary, *o.session.topology(), x);
    for (std::size_t i = 0; i < grip.nodes.size(); ++i) {
      const ImVec2 at = pixel(o.view.to_screen(x.xy(grip.nodes[i])));
      const auto share = static_cast<float>(grip.shares[i]);
      list.AddCircleFilled(at, o.theme.px(2.0f + 3.0f * share), palette().card);
      list.AddCircleFilled(at, o.theme.px(1.0f + 3.0f * share),
                           faded(palette().accent, 0.35f + 0.65f * share));
    }
  }
  if (const auto& node = o.viewport.hovered_node(); node && node->node < x.size()) {
    const ImVec2 at = pixel(o.view.to_screen(x.xy(node->node)));
    list.AddCircle(at, o.theme.px(7), palette().card, 24, o.theme.px(4));
    list.AddCircle(at, o.theme.px(7), palette().accent, 24, o.theme.px(2));
  }
}

/// What is typed, in place of how far the mouse has gone.
std::string typed_text(const Overlay& o) {
  const TypedMotion& typed = o.viewport.typed();
  const MotionGesture& drag = o.viewport.drag();
  std::string text;
  if (drag.kind() == MotionGesture::Kind::rotate)
    text = typed_field(typed, 0) + "\xC2\xB0";
  else if (drag.axis())
    text = (*drag.axis() == 0 ? "x " : "y ") + typed_field(typed, 0);
  else
    text = "x " + typed_field(typed, 0) + "   y " + typed_field(typed, 1) + "   Tab: the other";
  return text + "   Enter applies";
}

std::string motion_text(const Overlay& o) {
  if (o.viewport.typed().active()) return typed_text(o);
  const MotionGesture& drag = o.viewport.drag();
  const RigidMotion& m = drag.motion();
  if (drag.kind() == MotionGesture::Kind::rotate)
    return label_number(m.rotate, "%+.2f") + "\xC2\xB0" +
           (drag.snapped() ? "   steps of 5\xC2\xB0" : "");
  std::string text = "x " + label_number(m.translate.x(), "%+.4g") + "   y " +
                     label_number(m.translate.y(), "%+.4g");
  if (drag.axis()) text += *drag.axis() == 0 ? "   along x" : "   along y";
  if (drag.snapped()) text += "   grid " + label_number(MotionGesture::grid_step(o.view, m.pivot));
  return text;
}

std::string hint_text(const Overlay& o) {
  if (o.viewport.gesture() == Viewport::Gesture::pivot) {
    const std::string& snapped = o.viewport.snapped_to();
    return snapped.empty() ? "Pivot; Ctrl snaps" : "Pivot: " + snapped;
  }
  if (const char* hint = handle_hint(o.viewport.hovered_handle()); *hint) return hint;
  if (const auto& node = o.viewport.hovered_node())
    return "Node " + std::to_string(node->node) + ": drag; Shift+click takes the arc up to it";
  return {};
}

Handle hot_handle(const Viewport& viewport) {
  if (viewport.gesture() == Viewport::Gesture::rotate) return Handle::ring;
  if (viewport.gesture() == Viewport::Gesture::pivot) return Handle::pivot;
  if (viewport.gesture() != Viewport::Gesture::move) return viewport.hovered_handle();
  const auto axis = viewport.drag().axis();
  if (!axis) return Handle::centre;
  return *axis == 0 ? Handle::arrow_x : Handle::arrow_y;
}

/// Rings around the nodes inspected and under the mouse.
void draw_rings(ImDrawList& list, const Overlay& o) {
  const NodeSelection& nodes = o.session.nodes();
  if (!o.session.document()) return;
  const Coordinates& x = o.session.coordinates();
  if (nodes.inspected())
    draw_node_ring(list, pixel(o.view.to_screen(x.xy(*nodes.inspected()))), o.theme.px(6),
                   o.theme.px(2), palette().accent);
  if (nodes.hovered())
    draw_node_ring(list, pixel(o.view.to_screen(x.xy(*nodes.hovered()))), o.theme.px(8),
                   o.theme.px(1.5f), palette().accent);
}

}  // namespace

void draw_pins(ImDrawList& list, const Overlay& o) {
  if (!o.session.document()) return;
  std::vector<NodalView> pinned;
  for (const Index node : o.session.nodes().pinned())
    pinned.push_back(inspect_node(*o.session.vcv(), o.session.coordinates(), node));
  draw_vcvs(list, o.view, pinned, o.theme.px(1), o.theme.small);
}

void draw_overlay(ImDrawList& list, const Overlay& o) {
  if (!o.session.document()) return;
  draw_pins(list, o);
  draw_rings(list, o);
  draw_region(list, o.session, o.view, o.theme);
  if (o.session.dragging()) draw_wanted(list, o);
  draw_preview(list, o);
  draw_layer_preview(list, o);
  if (!o.scene.shape.active) return;
  draw_boundary_nodes(list, o);
  draw_shape(list, o);
}

void draw_handles(ImDrawList& list, const Overlay& o) {
  if (!o.session.document()) return;
  if (const auto gizmo = Viewport::gizmo(o.scene, o.view))
    draw_gizmo(list, *gizmo, hot_handle(o.viewport),
               o.viewport.gesture() == Viewport::Gesture::rotate, o.theme);
}

void draw_mouse_labels(ImDrawList& list, const Overlay& o) {
  if (!o.session.document()) return;
  if (o.session.dragging() && o.viewport.dragging())
    return draw_beside_mouse(list, o.view, o.theme, drag_labels(motion_text(o), o.session));
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
    at += wanted_length(column, k) * column.direction;
    points.push_back(view.to_screen(at));
  }
  return points;
}

/// The outlines of layers that can be told apart on screen, and the last one.
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
    list.AddLine(pixel(from), pixel(to), faded(palette().accent, 0.7f), o.theme.px(1));
  }
}

double distance(const ScreenPoint& p, const ScreenPoint& a, const ScreenPoint& b) {
  const double length = (b - a).squared_norm();
  const double t = length > 0 ? std::clamp((p - a).dot(b - a) / length, 0.0, 1.0) : 0.0;
  return (p - a - t * (b - a)).norm();
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
  const LayerStack* plan = o.session.jobs().layer_preview().plan();
  if (!plan || o.session.in_motion()) return;
  const Coordinates& x = o.session.jobs().layer_preview().coordinates();
  const ScreenPoint pointer(ImGui::GetIO().MousePos);
  double nearest = static_cast<double>(o.theme.px(6));
  const LayerColumn* pointed = nullptr;
  std::vector<std::vector<ScreenPoint>> columns;
  columns.reserve(plan->columns.size());
  for (const LayerColumn& column : plan->columns) {
    columns.push_back(points_of(column, x, o.view));
    const auto& points = columns.back();
    const bool cut = cut_short(column);
    list.AddLine(pixel(points.front()), pixel(points.back()),
                 cut ? palette().warning : palette().accent, o.theme.px(cut ? 2.0f : 1.0f));
    if (cut && points.size() == 1)
      list.AddCircleFilled(pixel(points.front()), o.theme.px(3), palette().warning);
    const double away = distance(pointer, points.front(), points.back());
    if (!cut || away > nearest) continue;
    nearest = away;
    pointed = &column;
  }
  // Under the outlines, which are too close together to have halos of their own.
  for (const ColumnPair& pair : plan->pairs)
    list.AddLine(pixel(columns[pair.left].back()), pixel(columns[pair.right].back()),
                 faded(palette().card, 0.85f), o.theme.px(4));
  for (const ColumnPair& pair : plan->pairs)
    draw_outlines(list, o, columns[pair.left], columns[pair.right]);
  if (pointed) draw_reason(list, o, *pointed);
}

}  // namespace winslow::gui
