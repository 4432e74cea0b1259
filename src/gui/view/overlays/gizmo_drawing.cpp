#include "gui/view/overlays/gizmo_drawing.h"

#include <utility>

namespace winslow::gui {

namespace {

ImU32 halo() { return faded(palette().card, 0.9f); }

void draw_ring(ImDrawList& list, const Gizmo& g, bool hot, bool turning, const Theme& theme) {
  const ImVec2 centre(g.pivot);
  const auto radius = static_cast<float>(g.radius);
  const float width = theme.px(hot ? 3.0f : 1.8f);
  list.AddCircle(centre, radius, halo(), 96, width + theme.px(3));
  list.AddCircle(centre, radius, palette().accent, 96, width);
  if (turning) {
    list.PathLineTo(centre);
    list.PathArcTo(centre, radius, static_cast<float>(-pi / 4), static_cast<float>(-g.angle), 64);
    list.PathFillConvex(faded(palette().accent, 0.1f));
  }
  const ImVec2 knob(g.knob());
  list.AddCircleFilled(knob, theme.px(hot ? 8.0f : 6.5f), palette().card);
  list.AddCircleFilled(knob, theme.px(hot ? 6.5f : 5.0f), palette().accent);
}

void draw_arrow(ImDrawList& list, const Gizmo& g, int axis, bool hot, const Theme& theme) {
  const ImU32 paint = axis == 0 ? palette().axis_x : palette().axis_y;
  const ImVec2 from(g.shaft(axis));
  const ImVec2 to(g.tip(axis));
  const ScreenVector shaft = g.tip(axis) - g.shaft(axis);
  const ScreenVector along = shaft / shaft.norm();
  const ScreenVector across(-along.y(), along.x());
  const double head = static_cast<double>(theme.px(hot ? 12.0f : 10.0f));
  const ScreenPoint end = g.tip(axis) + 0.5 * head * along;
  const ScreenPoint left = end - head * along + 0.42 * head * across;
  const ScreenPoint right = end - head * along - 0.42 * head * across;
  const float width = theme.px(hot ? 3.2f : 2.2f);
  list.AddLine(from, to, halo(), width + theme.px(3));
  list.AddTriangle(ImVec2(end), ImVec2(left), ImVec2(right), halo(), theme.px(3));
  list.AddLine(from, to, paint, width);
  list.AddTriangleFilled(ImVec2(end), ImVec2(left), ImVec2(right), paint);
}

void draw_centre(ImDrawList& list, const Gizmo& g, bool hot, const Theme& theme) {
  const ImVec2 c(g.pivot);
  list.AddCircleFilled(c, theme.px(hot ? 8.0f : 6.5f), palette().card);
  list.AddCircleFilled(c, theme.px(hot ? 6.5f : 5.0f), palette().accent);
  list.AddCircleFilled(c, theme.px(1.8f), palette().card);
}

/// A crosshair beside the centre, tied to it by a line.
void draw_pin(ImDrawList& list, const Gizmo& g, bool hot, const Theme& theme) {
  const ImVec2 c(g.pin());
  const float r = theme.px(hot ? 6.0f : 4.6f);
  const float arm = r + theme.px(2.5f);
  for (const auto& [paint, width] :
       {std::pair{halo(), theme.px(4)}, std::pair{palette().accent, theme.px(1.5f)}}) {
    list.AddCircle(c, r, paint, 24, width);
    list.AddLine(ImVec2(c.x - arm, c.y), ImVec2(c.x + arm, c.y), paint, width);
    list.AddLine(ImVec2(c.x, c.y - arm), ImVec2(c.x, c.y + arm), paint, width);
  }
}

}  // namespace

void draw_gizmo(ImDrawList& list, const Gizmo& gizmo, Handle hot, bool turning,
                const Theme& theme) {
  draw_ring(list, gizmo, hot == Handle::ring, turning, theme);
  draw_arrow(list, gizmo, 0, hot == Handle::arrow_x, theme);
  draw_arrow(list, gizmo, 1, hot == Handle::arrow_y, theme);
  draw_pin(list, gizmo, hot == Handle::pivot, theme);
  draw_centre(list, gizmo, hot == Handle::centre, theme);
}

const char* handle_hint(Handle handle) {
  switch (handle) {
    case Handle::centre:
      return "Move freely";
    case Handle::arrow_x:
      return "Move along x";
    case Handle::arrow_y:
      return "Move along y";
    case Handle::ring:
      return "Turn about the pivot";
    case Handle::pivot:
      return "Put the pivot elsewhere; Ctrl snaps";
    case Handle::none:
      break;
  }
  return "";
}

}  // namespace winslow::gui
