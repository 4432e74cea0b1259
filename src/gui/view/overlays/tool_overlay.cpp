#include "gui/view/overlays/tool_overlay.h"

#include "gui/base/text.h"
#include "gui/document/jobs/body_drag.h"
#include "gui/widgets/controls.h"

namespace winslow::gui {

namespace {

ImVec2 beside_mouse(const View& view, const Theme& theme, const ImVec2& size) {
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  const ScreenBox seen = view.viewport();
  const ImVec2 start = static_cast<ImVec2>(seen.min);
  const float right = start.x + static_cast<float>(seen.size().x());
  const float bottom = start.y + static_cast<float>(seen.size().y());
  ImVec2 at(mouse.x + theme.px(18), mouse.y + theme.px(14));
  if (at.x + size.x > right) at.x = std::max(start.x, mouse.x - theme.px(12) - size.x);
  if (at.y + size.y > bottom) at.y = std::max(start.y, mouse.y - theme.px(8) - size.y);
  return at;
}

}  // namespace

void draw_beside_mouse(ImDrawList& list, const View& view, const Theme& theme,
                       const std::vector<MouseLabel>& labels) {
  const float pad = theme.px(7);
  const float height = ImGui::GetTextLineHeight() + 1.4f * pad;
  const float step = height + theme.px(3);
  float width = 0;
  for (const MouseLabel& label : labels)
    width = std::max(width, ImGui::CalcTextSize(label.text.c_str()).x + 2 * pad);
  ImVec2 at = beside_mouse(view, theme, ImVec2(width, static_cast<float>(labels.size()) * step));
  for (const MouseLabel& label : labels) {
    const ImVec2 size = ImGui::CalcTextSize(label.text.c_str());
    list.AddRectFilled(at, ImVec2(at.x + size.x + 2 * pad, at.y + height),
                       faded(label.background, 0.88f), theme.px(5));
    list.AddText(ImVec2(at.x + pad, at.y + 0.7f * pad), palette().card, label.text.c_str());
    at.y += step;
  }
}

std::vector<MouseLabel> drag_labels(std::string motion, const Session& session) {
  std::vector<MouseLabel> labels{{std::move(motion), palette().text}};
  const BodyDrag* drag = session.mesh().work().body_drag();
  if (!drag || drag->reach() == BodyDrag::Reach::there) return labels;
  if (drag->reach() == BodyDrag::Reach::limit)
    labels.push_back({blocked_text(*drag), palette().danger});
  else
    labels.push_back({updating_text(*drag), palette().text_dim});
  return labels;
}

std::string typed_field(const TypedMotion& typed, std::size_t field) {
  const bool here = typed.field() == field;
  const std::string& text = typed.text(field);
  return (text.empty() && !here ? "0" : text) + (here ? "|" : "");
}

namespace {

using Kind = Handle::Kind;

constexpr float at_the_back = 0.45f;  // opacity of parts that point away
constexpr float set_aside = 0.25f;    // of parts that are not held, in a drag

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

/// Splits a ring into connected runs of points on one side of its centre.
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

/// Draws the knob on the ring of the plane, an obvious place to grab it.
void draw_knob(const Drawing& d) {
  if (!d.g.knob) return;
  const Handle handle{Kind::ring, 2};
  const float strength = d.strength(handle);
  const ImVec2 c = on_list(*d.g.knob);
  d.list.AddCircleFilled(c, d.theme.px(d.hot(handle) ? 8.0f : 6.5f), d.halo(strength));
  d.list.AddCircleFilled(c, d.theme.px(d.hot(handle) ? 6.5f : 5.0f),
                         faded(color_of_axis(2), strength));
}

/// Draws the pin, a crosshair beside the centre.
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

/// Draws the angle of a drag, from where the ring was grabbed.
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

/// Draws the line along which a drag moves, or about which it turns.
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

/// The visible place of a ring that is farthest from the other rings.
std::optional<ScreenPoint> free_place_of_ring(const View& view, const Gizmo& g, int axis) {
  std::optional<ScreenPoint> best;
  double most = 0;
  if (axis == 2 && g.knob) return g.knob;
  for (const auto& point : g.rings[at(axis)]) {
    if (!point.front || !view.viewport().contains(point.at) ||
        g.handle_at(point.at) != Handle{Kind::ring, axis})
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

/// Notes the places of the handles for scripts.
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
    text = typed.active() ? typed_field(typed, 0) : formatted(drag.rotate(), "%+.2f");
    text += "\xC2\xB0";
    if (const std::string axis = drag.axis_name(); !axis.empty()) text += " about " + axis;
    if (drag.snapped() && !typed.active()) text += "   steps of 5\xC2\xB0";
    return text + (typed.active() ? "   Enter applies" : "");
  }
  const auto along = drag.directions();
  for (std::size_t k = 0; k < along.size(); ++k)
    text += (k == 0 ? "" : "   ") + std::string(along[k].name) + ' ' +
            (typed.active() ? typed_field(typed, k)
                            : formatted(drag.translate().dot(along[k].along), "%+.4g"));
  if (typed.active())
    return text + (along.size() > 1 ? "   Tab: next   Enter applies" : "   Enter applies");
  if (drag.snapped()) text += "   steps of " + short_number(drag.snap_step(view));
  return text;
}

namespace {

ImVec2 projected(const ViewOverlay& o, const Vec3& p) { return ImVec2(o.view.project(p).at); }

void draw_leg(ImDrawList& list, const ViewOverlay& o, const Vec3& a, const Vec3& b) {
  const ImVec2 from = projected(o, a), to = projected(o, b);
  list.AddLine(from, to, faded(palette().card, 0.85f), o.theme.px(5));
  list.AddLine(from, to, palette().accent, o.theme.px(2));
}

/// Draws the measured angle as an arc in the plane of both legs.
void draw_arc(ImDrawList& list, const ViewOverlay& o, const std::vector<RulerPoint>& points) {
  const Vec3 corner = points[1].at;
  const Vec3 a = points[0].at - corner, b = points[2].at - corner;
  const Vec3 u = a.normalized(), normal = a.cross(b);
  const Vec3 v = normal.norm() > 0 ? Vec3(normal.cross(a).normalized()) : Vec3(0, 0, 0);
  const double angle = std::atan2(normal.norm(), a.dot(b));
  const double radius = std::min({o.view.pixel_size(corner) * static_cast<double>(o.theme.px(34)),
                                  0.6 * a.norm(), 0.6 * b.norm()});
  constexpr int pieces = 32;
  for (int k = 0; k <= pieces; ++k) {
    const double t = angle * k / pieces;
    list.PathLineTo(projected(o, corner + radius * (std::cos(t) * u + std::sin(t) * v)));
  }
  list.PathStroke(palette().accent, 0, o.theme.px(2));
}

void draw_point(ImDrawList& list, const ViewOverlay& o, const RulerPoint& point) {
  const ImVec2 at = projected(o, point.at);
  list.AddCircleFilled(at, o.theme.px(5), palette().card);
  list.AddCircleFilled(at, o.theme.px(3.2f), palette().accent);
  // A ring marks a point on a node.
  if (point.node) list.AddCircle(at, o.theme.px(8), palette().accent, 24, o.theme.px(1.5f));
}

/// Draws lines of text on one card beside a place, inside the view.
void draw_card(ImDrawList& list, const ViewOverlay& o, const ScreenPoint& beside,
               const std::vector<std::string>& lines) {
  const Theme& theme = o.theme;
  ImFont& font = *theme.small;
  const float pad = theme.px(7), step = font.FontSize + theme.px(3);
  float width = 0;
  for (const std::string& line : lines)
    width = std::max(width, font.CalcTextSizeA(font.FontSize, FLT_MAX, 0, line.c_str()).x);
  const ImVec2 size(width + 2 * pad, static_cast<float>(lines.size()) * step + pad);
  const ImVec2 low(o.view.viewport().min), high(o.view.viewport().max);
  ImVec2 at(static_cast<float>(beside.x()) + theme.px(16),
            static_cast<float>(beside.y()) + theme.px(16));
  at.x = std::max(low.x, std::min(at.x, high.x - size.x - pad));
  at.y = std::max(low.y, std::min(at.y, high.y - size.y - pad));
  const ImVec2 end(at.x + size.x, at.y + size.y);
  list.AddRectFilled(at, end, faded(palette().card, 0.94f), theme.px(5));
  list.AddRect(at, end, palette().border, theme.px(5));
  for (std::size_t k = 0; k < lines.size(); ++k)
    list.AddText(&font, font.FontSize,
                 ImVec2(at.x + pad, at.y + pad / 2 + static_cast<float>(k) * step), palette().text,
                 lines[k].c_str());
  ui::note("ruler", at, end);
}

}  // namespace

std::vector<std::string> measurement_lines(const Measurement& m) {
  // Rounding errors of the nodes do not count as a distance.
  const auto rounded = [](double value, double unit) {
    return std::abs(value) < 1e-9 * unit ? 0.0 : value;
  };
  const auto part = [&](Index k) { return formatted(rounded(m.along[k], m.length), "%+.6g"); };
  std::vector<std::string> lines;
  lines.push_back("Length " + formatted(m.length, "%.6g"));
  lines.push_back("x " + part(0) + "   y " + part(1) + (m.direction ? "" : "   z " + part(2)));
  if (m.direction) lines.push_back(formatted(rounded(*m.direction, 180), "%.2f\xC2\xB0 against x"));
  if (m.faces) lines.push_back("Between the faces " + formatted(*m.faces, "%.2f\xC2\xB0"));
  if (m.second) lines.push_back("Second length " + formatted(*m.second, "%.6g"));
  if (m.angle) lines.push_back("Angle " + formatted(*m.angle, "%.2f\xC2\xB0"));
  return lines;
}

void draw_ruler(ImDrawList& list, const ViewOverlay& o, const Ruler& ruler) {
  const std::vector<RulerPoint> points = ruler.drawn();
  const auto measured = measure(points);
  for (std::size_t k = 1; k < points.size(); ++k) draw_leg(list, o, points[k - 1].at, points[k].at);
  if (measured && measured->angle) draw_arc(list, o, points);
  for (const RulerPoint& point : points) draw_point(list, o, point);
  if (measured)
    draw_card(list, o, o.view.project(points.back().at).at, measurement_lines(*measured));
}

}  // namespace winslow::gui
