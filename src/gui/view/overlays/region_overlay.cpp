#include "gui/view/overlays/region_overlay.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "gui/widgets/controls.h"

namespace winslow::gui {

namespace {

/// Dashes along closed lines of points in the mesh.
class DashedLines {
 public:
  DashedLines(ImDrawList& list, const View& view, const Theme& theme)
      : list_(list), view_(view), theme_(theme) {}

  void loop(const std::vector<Vec3>& points) {
    walked_ = 0;
    for (std::size_t i = 0; i < points.size(); ++i)
      segment(points[i], points[(i + 1) % points.size()]);
  }

 private:
  void segment(const Vec3& from, const Vec3& to) {
    const auto a = static_cast<ImVec2>(view_.project(from).at);
    const auto b = static_cast<ImVec2>(view_.project(to).at);
    const float period = theme_.px(dash + gap);
    const float length = std::hypot(b.x - a.x, b.y - a.y);
    if (!std::isfinite(length)) return;
    // A line much longer than the window is seen in part only: no dashes by the thousand.
    if (length > 400 * period || length == 0) return list_.AddLine(a, b, ink(), width());
    for (float at = -walked_; at < length; at += period) {
      const float start = std::max(at, 0.0f), end = std::min(at + theme_.px(dash), length);
      if (end <= start) continue;
      const auto point = [&](float s) {
        return ImVec2(a.x + (b.x - a.x) * s / length, a.y + (b.y - a.y) * s / length);
      };
      list_.AddLine(point(start), point(end), ink(), width());
    }
    walked_ = std::fmod(walked_ + length, period);
  }
  static ImU32 ink() { return palette().accent; }
  float width() const { return theme_.px(1.5f); }

  static constexpr float dash = 7, gap = 5;  // pixels at 100 %
  ImDrawList& list_;
  const View& view_;
  const Theme& theme_;
  float walked_ = 0;
};

std::vector<Vec3> circle(const Vec3& centre, double radius, const Vec3& u, const Vec3& v) {
  constexpr int sides = 96;
  std::vector<Vec3> points;
  for (int k = 0; k < sides; ++k) {
    const double angle = 2 * std::numbers::pi * k / sides;
    points.emplace_back(centre + radius * (std::cos(angle) * u + std::sin(angle) * v));
  }
  return points;
}

void draw_rectangle(DashedLines& lines, const KeepOutside& keep) {
  const Vec3 a = keep.corner_point(), b = keep.opposite_point();
  lines.loop({a, Vec3(b.x(), a.y(), 0), b, Vec3(a.x(), b.y(), 0)});
}

/// Its twelve edges: two rectangles, and what joins them.
void draw_box(DashedLines& lines, const KeepOutside& keep) {
  const Vec3 a = keep.corner_point(), b = keep.opposite_point();
  const std::array<Vec3, 4> foot{Vec3(a.x(), a.y(), a.z()), Vec3(b.x(), a.y(), a.z()),
                                 Vec3(b.x(), b.y(), a.z()), Vec3(a.x(), b.y(), a.z())};
  std::vector<Vec3> low(foot.begin(), foot.end()), high = low;
  for (Vec3& point : high) point.z() = b.z();
  lines.loop(low);
  lines.loop(high);
  for (std::size_t k = 0; k < low.size(); ++k) lines.loop({low[k], high[k]});
}

void draw_sphere(DashedLines& lines, const Vec3& centre, double radius) {
  const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();
  for (const auto& [u, v] : {std::pair{x, y}, std::pair{y, z}, std::pair{z, x}})
    lines.loop(circle(centre, radius, u, v));
}

/// Where the circle or the sphere is. None: nothing is selected that it could be about.
std::optional<Vec3> centre_of(const KeepOutside& keep, const Session& session) {
  if (keep.centre) return keep.centre_point();
  if (session.in_space()) {
    const Selection& selection = session.selection();
    return selection.empty() ? std::nullopt : std::optional(selection.space().centre());
  }
  const auto& anchors = session.selection().anchors();
  if (!anchors) return std::nullopt;
  return Vec3(anchors->centre.x(), anchors->centre.y(), 0);
}

}  // namespace

void draw_region(ImDrawList& list, const Session& session, const View& view, const Theme& theme) {
  const KeepOutside& keep = session.jobs().smooth_options().keep_outside;
  if (!keep.given()) return;
  const bool space = session.in_space();
  DashedLines lines(list, view, theme);
  if (keep.corner && keep.opposite) space ? draw_box(lines, keep) : draw_rectangle(lines, keep);
  if (keep.radius) {
    const auto centre = centre_of(keep, session);
    if (!centre) return;
    if (space)
      draw_sphere(lines, *centre, *keep.radius);
    else
      lines.loop(circle(*centre, *keep.radius, Vec3::UnitX(), Vec3::UnitY()));
  }
  const ScreenBox seen = view.viewport();
  ui::note("region", static_cast<ImVec2>(seen.min), static_cast<ImVec2>(seen.max));
}

}  // namespace winslow::gui
