#include "gui/view/overlays/gizmo_drawing.h"

#include "gui/view/overlays/mouse_labels.h"
#include "gui/widgets/controls.h"

namespace winslow::gui {

namespace {

using Kind = Handle::Kind;

constexpr float at_the_back = 0.45f;  // opacity of what points away
constexpr float set_aside = 0.25f;    // of what is not held, in a drag

ImVec2 on_list(const ScreenPoint& p) { return static_cast<ImVec2>(p); }

struct Drawing {
  ImDrawList& list;
  const View& view;
  const Theme& theme;
  const Gizmo& g;
  const Mover& mover;

  bool hot(const Handle& handle) const { return mover.handle() == handle; }
  /// Opacity of a handle.
  float strength(const Handle& handle) const {
    return mover.dragging() && !hot(handle) ? set_aside : 1.0f;
  }
  ImU32 halo(float share) const { return faded(palette().card, 0.85f * share); }
};

ImU32 color_of_axis(int axis) {
  const Palette& p = palette();
  return std::array<ImU32, 3>{p.axis_x, p.axis_y, p.axis_z}[at(axis)];
}

/// The points of a ring that hang together on one side of its centre.
std::vector<std::vector<ImVec2>> runs_of(const std::vector<Gizmo::RingPoint>& ring, bool front) {
  std::vector<std::vector<ImVec2>> runs;
  const std::size_t n = ring.size();
  const auto belongs = [&](std::size_t k) { return ring[k % n].front == front; };
  std::size_t start = 0;
  while (start < n && belongs(start)) ++start;
  if (start == n) {  // all of it
    std::vector<ImVec2> whole;
    for (std::size_t k = 0; k <= n; ++k) whole.push_back(on_list(ring[k % n].at));
    return {whole};
  }
  for (std::size_t k = start; k < start + n; ++k) {
    if (!belongs(k)) continue;
    if (runs.empty() || !belongs(k - 1 + n)) runs.emplace_back();
    runs.back().push_back(on_list(ring[k % n].at));
  }
  return runs;
}

void draw_run(const Drawing& d, const std::vector<ImVec2>& run, ImU32 color, float width) {
  d.list.AddPolyline(run.data(), static_cast<int>(run.size()), color, 0, width);
}

void draw_ring_side(const Drawing& d, int axis, bool front) {
  const Handle handle{Kind::ring, axis};
  if (!d.g.has(handle)) return;
  const float strength = d.strength(handle) * (front ? 1.0f : at_the_back);
  const float width = d.theme.px(front && d.hot(handle) ? 3.4f : front ? 2.0f : 1.2f);
  for (const auto& run : runs_of(d.g.rings[at(axis)], front)) {
    if (front) draw_run(d, run, d.halo(strength), width + d.theme.px(2.4f));
    draw_run(d, run, faded(color_of_axis(axis), strength), width);
  }
}

void draw_screen_ring(const Drawing& d) {
  const Handle handle{Kind::screen_ring, 0};
  if (!d.g.has(handle)) return;
  const float strength = d.strength(handle);
  const float width = d.theme.px(d.hot(handle) ? 3.0f : 1.5f);
  const auto radius = static_cast<float>(d.g.screen_radius);
  d.list.AddCircle(on_list(d.g.centre), radius, d.halo(strength), 96, width + d.theme.px(2.4f));
  d.list.AddCircle(on_list(d.g.centre), radius,
                   faded(d.hot(handle) ? palette().accent : palette().text_dim, strength), 96,
                   width);
}

void draw_letter(const Drawing& d, const ScreenPoint& place, const char* text, ImU32 color,
                 float strength) {
  ImFont& font = *d.theme.small;
  const ImVec2 size = font.CalcTextSizeA(font.FontSize, 1e6f, 0, text);
  const ImVec2 corner(static_cast<float>(place.x()) - size.x / 2,
                      static_cast<float>(place.y()) - size.y / 2);
  const float room = d.theme.px(2);
  d.list.AddRectFilled({corner.x - room, corner.y}, {corner.x + size.x + room, corner.y + size.y},
                       d.halo(0.9f * strength), d.theme.px(3));
  d.list.AddText(&font, font.FontSize, corner, faded(color, strength), text);
}

void draw_arrow(const Drawing& d, int axis) {
  const Handle handle{Kind::arrow, axis};
  const bool takes = d.g.has(handle);
  const bool away = d.g.frame().axes[at(axis)].dot(d.g.viewer) < -0.3;
  const float strength = d.strength(handle) * (takes ? (away ? 0.75f : 1.0f) : at_the_back);
  const ScreenVector shaft = d.g.tips[at(axis)] - d.g.shafts[at(axis)];
  if (shaft.norm() < 1) return;
  const ScreenVector along = shaft / shaft.norm(), across(-along.y(), along.x());
  const double head = static_cast<double>(d.theme.px(d.hot(handle) ? 13.0f : 11.0f));
  const ScreenPoint foot = d.g.tips[at(axis)] - 0.5 * head * along;
  const ScreenPoint end = foot + head * along;
  const ImVec2 left = on_list(foot + 0.4 * head * across),
               right = on_list(foot - 0.4 * head * across);
  const float width = d.theme.px(d.hot(handle) ? 3.6f : 2.4f);
  const ImU32 color = faded(color_of_axis(axis), strength);
  d.list.AddLine(on_list(d.g.shafts[at(axis)]), on_list(foot), d.halo(strength),
                 width + d.theme.px(2.6f));
  d.list.AddTriangle(on_list(end), left, right, d.halo(strength), d.theme.px(2.6f));
  d.list.AddLine(on_list(d.g.shafts[at(axis)]), on_list(foot), color, width);
  d.list.AddTriangleFilled(on_list(end), left, right, color);
  if (takes)
    draw_letter(d, end + static_cast<double>(d.theme.px(8)) * along, d.g.frame().name(axis),
                color_of_axis(axis), strength);
}

void draw_square(const Drawing& d, int axis) {
  const Handle handle{Kind::square, axis};
  if (!d.g.has(handle)) return;
  const float strength = d.strength(handle);
  std::array<ImVec2, 4> corners;
  for (std::size_t k = 0; k < 4; ++k) corners[k] = on_list(d.g.squares[at(axis)][k]);
  d.list.AddConvexPolyFilled(corners.data(), 4, d.halo(strength));
  d.list.AddConvexPolyFilled(
      corners.data(), 4, faded(color_of_axis(axis), (d.hot(handle) ? 0.75f : 0.35f) * strength));
  d.list.AddPolyline(corners.data(), 4, faded(color_of_axis(axis), strength), ImDrawFlags_Closed,
                     d.theme.px(d.hot(handle) ? 2.2f : 1.4f));
}

void draw_middle(const Drawing& d) {
  const Handle handle{Kind::centre, 0};
  const float strength = d.strength(handle);
  const ImVec2 c = on_list(d.g.centre);
  d.list.AddCircleFilled(c, d.theme.px(d.hot(handle) ? 8.5f : 7.0f), d.halo(strength));
  d.list.AddCircleFilled(c, d.theme.px(d.hot(handle) ? 6.8f : 5.4f),
                         faded(palette().accent, strength));
  d.list.AddCircleFilled(c, d.theme.px(1.8f), palette().card);
}

/// On the ring of the plane: a place to take it by that is seen at once.
void draw_knob(const Drawing& d) {
  if (!d.g.knob) return;
  const Handle handle{Kind::ring, 2};
  const float strength = d.strength(handle);
  const ImVec2 c = on_list(*d.g.knob);
  d.list.AddCircleFilled(c, d.theme.px(d.hot(handle) ? 8.0f : 6.5f), d.halo(strength));
  d.list.AddCircleFilled(c, d.theme.px(d.hot(handle) ? 6.5f : 5.0f),
                         faded(color_of_axis(2), strength));
}

/// A crosshair beside the centre.
void draw_pin(const Drawing& d) {
  if (!d.g.pin) return;
  const Handle handle{Kind::pin, 0};
  const ImVec2 c = on_list(*d.g.pin);
  const float r = d.theme.px(d.hot(handle) ? 6.0f : 4.6f);
  const float arm = r + d.theme.px(2.5f);
  const float strength = d.strength(handle);
  for (const auto& [paint, width] :
       {std::pair{d.halo(strength), d.theme.px(4)},
        std::pair{faded(palette().accent, strength), d.theme.px(1.5f)}}) {
    d.list.AddCircle(c, r, paint, 24, width);
    d.list.AddLine(ImVec2(c.x - arm, c.y), ImVec2(c.x + arm, c.y), paint, width);
    d.list.AddLine(ImVec2(c.x, c.y - arm), ImVec2(c.x, c.y + arm), paint, width);
  }
}

/// The angle that a drag has turned by, from where the ring was taken.
void draw_swept(const Drawing& d) {
  if (!d.mover.dragging() || !d.mover.gesture().turns()) return;
  const MotionGesture& gesture = d.mover.gesture();
  const double radius =
      gesture.handle().kind == Kind::screen_ring ? d.g.screen_radius : d.g.ring_radius;
  const double angle = gesture.rotate();
  const double shown = std::clamp(angle, -360.0, 360.0);
  const int steps = std::max(2, static_cast<int>(std::ceil(std::abs(shown) / 4)));
  const auto place = [&](double degrees) {
    return on_list(
        on_ring(d.view, d.g.place.pivot, gesture.axis(), gesture.grip(), degrees, radius));
  };
  const ImVec2 centre = on_list(d.g.centre);
  for (int k = 0; k < steps; ++k)
    d.list.AddTriangleFilled(centre, place(shown * k / steps), place(shown * (k + 1) / steps),
                             faded(palette().accent, 0.16f));
  for (const double degrees : {0.0, angle}) {
    d.list.AddLine(centre, place(degrees), d.halo(1), d.theme.px(4));
    d.list.AddLine(centre, place(degrees), palette().accent, d.theme.px(1.6f));
  }
}

/// The line along which a drag moves, or about which it turns.
void draw_guide(const Drawing& d) {
  if (!d.mover.dragging()) return;
  const MotionGesture& gesture = d.mover.gesture();
  const auto along = gesture.directions();
  if (!gesture.turns() && along.size() != 1) return;
  const Vec3 line = gesture.turns() ? gesture.axis() : along[0].along;
  const double reach = 2.4 * d.g.ring_radius * d.view.pixel_size(d.g.place.pivot);
  d.list.AddLine(on_list(d.view.project(d.g.place.pivot - reach * line).at),
                 on_list(d.view.project(d.g.place.pivot + reach * line).at),
                 faded(palette().accent, 0.55f), d.theme.px(1.2f));
}

void note_handle(const std::string& id, const ScreenPoint& p) {
  const ImVec2 at = on_list(p);
  ui::note("gizmo/" + id, {at.x - 3, at.y - 3}, {at.x + 3, at.y + 3});
}

/// The place of a ring, in the view, that is farthest from the others.
std::optional<ScreenPoint> free_place_of_ring(const View& view, const Gizmo& g, int axis) {
  std::optional<ScreenPoint> best;
  double most = 0;
  if (axis == 2 && g.knob) return g.knob;
  for (const auto& point : g.rings[at(axis)]) {
    if (!point.front || !view.viewport().contains(point.at) ||
        g.at(point.at) != Handle{Kind::ring, axis})
      continue;
    double room = 1e300;
    for (int other = 0; other < 3; ++other)
      for (const auto& there : g.rings[at(other)])
        if (other != axis && there.front) room = std::min(room, (there.at - point.at).norm());
    if (room <= most) continue;
    most = room;
    best = point.at;
  }
  return best;
}

/// Where scripts find the handles.
void note_handles(const View& view, const Gizmo& g) {
  note_handle("centre", g.centre);
  if (g.pin) note_handle("pin", *g.pin);
  for (int k = 0; k < 3; ++k) {
    const std::string name = g.frame().name(k);
    if (g.has({Kind::arrow, k})) note_handle("arrow/" + name, g.tips[at(k)]);
    if (g.has({Kind::square, k}))
      note_handle("square/" + name, midpoint(g.squares[at(k)][0], g.squares[at(k)][2]));
    if (const auto place = free_place_of_ring(view, g, k)) note_handle("ring/" + name, *place);
  }
  if (g.has({Kind::screen_ring, 0}))
    note_handle("screen_ring",
                g.centre + g.screen_radius * ScreenVector(std::cos(pi / 4), -std::sin(pi / 4)));
}

}  // namespace

void draw_gizmo(ImDrawList& list, const View& view, const Theme& theme, const Gizmo& g,
                const Mover& mover) {
  const Drawing d{list, view, theme, g, mover};
  draw_guide(d);
  draw_swept(d);
  draw_screen_ring(d);
  for (int k = 0; k < 3; ++k) draw_ring_side(d, k, false);
  // From the back to the front.
  std::array<int, 3> order{0, 1, 2};
  std::ranges::sort(order, {}, [&](int k) { return g.frame().axes[at(k)].dot(g.viewer); });
  for (const int k : order)
    if (g.frame().axes[at(k)].dot(g.viewer) < 0) draw_arrow(d, k);
  for (int k = 0; k < 3; ++k) draw_ring_side(d, k, true);
  draw_knob(d);
  for (int k = 0; k < 3; ++k) draw_square(d, k);
  for (const int k : order)
    if (g.frame().axes[at(k)].dot(g.viewer) >= 0) draw_arrow(d, k);
  draw_pin(d);
  draw_middle(d);
  note_handles(view, g);
}

std::string handle_hint(const Handle& handle, const GizmoPlace& place) {
  const GizmoFrame& frame = place.frame;
  const std::string name = frame.name(handle.axis);
  const std::string next = frame.name((handle.axis + 1) % 3),
                    last = frame.name((handle.axis + 2) % 3);
  const bool picked = frame.aligned && handle.axis == 2;
  switch (handle.kind) {
    case Kind::centre:
      return place.in_plane ? "Move freely" : "Move across the view";
    case Kind::arrow:
      return "Move along " + std::string(picked ? "the " : "") + name;
    case Kind::square:
      return "Move in the plane of " + next + " and " + last;
    case Kind::ring:
      if (place.in_plane) return "Turn about the pivot";
      return "Turn about " + std::string(picked ? "the " : "") + name;
    case Kind::screen_ring:
      return "Turn about the line of sight";
    case Kind::pin:
      return "Put the pivot elsewhere; Ctrl snaps";
    case Kind::none:
      break;
  }
  return "";
}

std::string motion_text(const Mover& mover, const View& view) {
  const MotionGesture& drag = mover.gesture();
  const TypedMotion& typed = mover.typed();
  std::string text;
  if (drag.turns()) {
    text = typed.active() ? typed_field(typed, 0) : label_number(drag.rotate(), "%+.2f");
    text += "\xC2\xB0";
    if (const std::string axis = drag.axis_name(); !axis.empty()) text += " about " + axis;
    if (drag.snapped() && !typed.active()) text += "   steps of 5\xC2\xB0";
    return text + (typed.active() ? "   Enter applies" : "");
  }
  const auto along = drag.directions();
  for (std::size_t k = 0; k < along.size(); ++k)
    text += (k == 0 ? "" : "   ") + std::string(along[k].name) + ' ' +
            (typed.active() ? typed_field(typed, k)
                            : label_number(drag.translate().dot(along[k].along), "%+.4g"));
  if (typed.active())
    return text + (along.size() > 1 ? "   Tab: next   Enter applies" : "   Enter applies");
  if (drag.snapped()) text += "   steps of " + label_number(drag.snap_step(view));
  return text;
}

}  // namespace winslow::gui
