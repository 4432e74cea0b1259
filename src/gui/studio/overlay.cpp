#include "gui/studio/overlay.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>

#include "core/inspect/nodal_view.h"
#include "core/motion/rigid_motion.h"
#include "gui/inspector/vcv_overlay.h"

namespace winslow::gui {

namespace {

ImVec2 pixel(const Vec2& p) { return {static_cast<float>(p.x()), static_cast<float>(p.y())}; }

std::string number(double value, const char* format = "%.4g") {
  std::array<char, 48> buffer{};
  std::snprintf(buffer.data(), buffer.size(), format, value);
  return buffer.data();
}

void draw_label(ImDrawList& list, const Theme& theme, const ImVec2& at, const std::string& text) {
  const ImVec2 size = ImGui::CalcTextSize(text.c_str());
  const float pad = theme.px(7);
  const ImVec2 end(at.x + size.x + 2 * pad, at.y + size.y + 1.4f * pad);
  list.AddRectFilled(at, end, faded(palette().text, 0.88f), theme.px(5));
  list.AddText(ImVec2(at.x + pad, at.y + 0.7f * pad), palette().card, text.c_str());
}

/// The selected markers where the mouse wants them: the solver is a step behind.
void draw_outline(ImDrawList& list, const Overlay& o) {
  const auto motion = o.session.live_motion();
  if (!motion) return;
  const Mesh& base = o.session.motion_base().mesh;
  for (Index m : o.session.selection())
    for (const auto& [a, b] : base.topology->markers()[static_cast<std::size_t>(m)].edges) {
      const Vec2 p = o.camera.to_screen(transform(*motion, base.coordinates.xy(a)));
      const Vec2 q = o.camera.to_screen(transform(*motion, base.coordinates.xy(b)));
      list.AddLine(pixel(p), pixel(q), palette().accent, o.theme.px(1.5f));
    }
}

void draw_ring(ImDrawList& list, const Overlay& o, const Handles& h) {
  const bool hot = o.viewport.hovered_handle() == Handle::ring ||
                   o.viewport.gesture() == Viewport::Gesture::rotate;
  const ImVec2 centre = pixel(h.pivot);
  const auto radius = static_cast<float>(h.radius);
  const float width = o.theme.px(hot ? 3.0f : 1.8f);
  list.AddCircle(centre, radius, faded(palette().card, 0.75f), 96, width + o.theme.px(2));
  list.AddCircle(centre, radius, hot ? palette().accent : faded(palette().accent, 0.67f), 96,
                 width);
  if (o.viewport.gesture() == Viewport::Gesture::rotate) {
    const auto from = static_cast<float>(-pi / 4);
    const auto to = static_cast<float>(-h.angle);
    list.PathLineTo(centre);
    list.PathArcTo(centre, radius, from, to, 64);
    list.PathFillConvex(faded(palette().accent, 0.1f));
  }
  const ImVec2 knob = pixel(h.knob());
  list.AddCircleFilled(knob, o.theme.px(hot ? 8.0f : 6.5f), palette().card);
  list.AddCircleFilled(knob, o.theme.px(hot ? 6.5f : 5.0f), palette().accent);
}

void draw_pivot(ImDrawList& list, const Overlay& o, const Handles& h) {
  const bool hot = o.viewport.hovered_handle() == Handle::pivot ||
                   o.viewport.gesture() == Viewport::Gesture::pivot;
  const ImVec2 c = pixel(h.pivot);
  const float r = o.theme.px(hot ? 7.0f : 5.5f);
  const float arm = r + o.theme.px(4);
  const ImU32 dark = palette().accent;
  for (const auto& [paint, width] :
       {std::pair{palette().card, o.theme.px(4)}, std::pair{dark, o.theme.px(1.6f)}}) {
    list.AddCircle(c, r, paint, 32, width);
    list.AddLine(ImVec2(c.x - arm, c.y), ImVec2(c.x + arm, c.y), paint, width);
    list.AddLine(ImVec2(c.x, c.y - arm), ImVec2(c.x, c.y + arm), paint, width);
  }
}

void draw_motion(ImDrawList& list, const Overlay& o) {
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  const ImVec2 at(mouse.x + o.theme.px(18), mouse.y + o.theme.px(14));
  const RigidMotion& m = o.viewport.motion();
  if (o.viewport.gesture() == Viewport::Gesture::rotate)
    draw_label(list, o.theme, at, number(m.rotate, "%+.2f") + "\xC2\xB0");
  else
    draw_label(
        list, o.theme, at,
        "x " + number(m.translate.x(), "%+.4g") + "   y " + number(m.translate.y(), "%+.4g"));
}

/// Rings around the nodes inspected and under the mouse.
void draw_rings(ImDrawList& list, const Overlay& o) {
  const NodeSelection& nodes = o.session.nodes();
  if (!o.session.document()) return;
  const Coordinates& x = o.session.coordinates();
  if (nodes.inspected())
    draw_node_ring(list, pixel(o.camera.to_screen(x.xy(*nodes.inspected()))), o.theme.px(6),
                   o.theme.px(2), palette().accent);
  if (nodes.hovered())
    draw_node_ring(list, pixel(o.camera.to_screen(x.xy(*nodes.hovered()))), o.theme.px(8),
                   o.theme.px(1.5f), palette().accent);
}

}  // namespace

void draw_pins(ImDrawList& list, const Overlay& o) {
  if (!o.session.document()) return;
  std::vector<NodalView> pinned;
  for (const Index node : o.session.nodes().pinned())
    pinned.push_back(inspect_node(*o.session.vcv(), o.session.coordinates(), node));
  draw_vcvs(list, o.camera, pinned, o.theme.px(1), o.theme.small);
}

void draw_overlay(ImDrawList& list, const Overlay& o) {
  draw_pins(list, o);
  draw_rings(list, o);
  if (o.session.dragging()) draw_outline(list, o);
  if (const auto handles = Viewport::handles(o.scene, o.camera)) {
    draw_ring(list, o, *handles);
    draw_pivot(list, o, *handles);
  }
  if (o.session.dragging() && o.viewport.dragging()) draw_motion(list, o);
}

}  // namespace winslow::gui
