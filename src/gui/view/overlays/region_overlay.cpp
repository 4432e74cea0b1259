#include "gui/view/overlays/region_overlay.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace winslow::gui {

namespace {

/// Dashes along a closed line of points in the mesh.
void draw_dashes(ImDrawList& list, const Overlay& o, const std::vector<Vec2>& points) {
  constexpr float dash = 7, gap = 5;  // pixels at 100 %
  const float period = o.theme.px(dash + gap);
  float walked = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto a = static_cast<ImVec2>(o.view.to_screen(points[i]));
    const auto b = static_cast<ImVec2>(o.view.to_screen(points[(i + 1) % points.size()]));
    const float length = std::hypot(b.x - a.x, b.y - a.y);
    // A line much longer than the window is seen in part only: no dashes by the thousand.
    if (length > 400 * period || length == 0) {
      list.AddLine(a, b, palette().accent, o.theme.px(1.5f));
      continue;
    }
    for (float at = -walked; at < length; at += period) {
      const float from = std::max(at, 0.0f), to = std::min(at + o.theme.px(dash), length);
      if (to <= from) continue;
      const auto point = [&](float s) {
        return ImVec2(a.x + (b.x - a.x) * s / length, a.y + (b.y - a.y) * s / length);
      };
      list.AddLine(point(from), point(to), palette().accent, o.theme.px(1.5f));
    }
    walked = std::fmod(walked + length, period);
  }
}

}  // namespace

void draw_region(ImDrawList& list, const Overlay& o) {
  const KeepOutside& keep = o.session.jobs().smooth_options().keep_outside;
  if (keep.corner && keep.opposite) {
    const Vec2 &a = *keep.corner, &b = *keep.opposite;
    draw_dashes(list, o, {a, Vec2(b.x(), a.y()), b, Vec2(a.x(), b.y())});
  }
  const auto& anchors = o.session.selection().anchors();
  if (!keep.radius || (!keep.centre && !anchors)) return;
  const Vec2 centre = keep.centre ? *keep.centre : anchors->centre;
  constexpr int sides = 96;
  std::vector<Vec2> points;
  for (int k = 0; k < sides; ++k) {
    const double angle = 2 * std::numbers::pi * k / sides;
    points.emplace_back(centre + *keep.radius * Vec2(std::cos(angle), std::sin(angle)));
  }
  draw_dashes(list, o, points);
}

}  // namespace winslow::gui
