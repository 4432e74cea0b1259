#include "gui/view/tools/gizmo.h"

#include <algorithm>
#include <cmath>

namespace winslow::gui {

namespace {

// Framebuffer pixels at scale 1.
constexpr double grip_radius = 9;
constexpr double centre_radius = 7;
constexpr double pin_radius = 7;
constexpr double pin_distance = 20;
constexpr double shaft_start = 12;
constexpr double shortest_arrow = 32, longest_arrow = 64;
constexpr double ring_gap = 26;
constexpr double smallest_ring = 52;

ScreenVector direction(int axis) { return axis == 0 ? ScreenVector(1, 0) : ScreenVector(0, -1); }

double distance_to_segment(const ScreenPoint& p, const ScreenPoint& a, const ScreenPoint& b) {
  const ScreenVector d = b - a;
  const double t = std::clamp((p - a).dot(d) / std::max(d.squared_norm(), 1e-30), 0.0, 1.0);
  return (p - a - t * d).norm();
}

}  // namespace

ScreenPoint Gizmo::knob() const {
  return pivot + radius * ScreenVector(std::cos(angle), -std::sin(angle));
}

ScreenPoint Gizmo::shaft(int axis) const { return pivot + shaft_start * scale * direction(axis); }

ScreenPoint Gizmo::tip(int axis) const {
  const double length = std::clamp(0.6 * radius, shortest_arrow * scale, longest_arrow * scale);
  return pivot + length * direction(axis);
}

ScreenPoint Gizmo::pin() const {
  return pivot + pin_distance * scale * ScreenVector(-0.7071, 0.7071);
}

Handle Gizmo::at(const ScreenPoint& p) const {
  const double r = grip_radius * scale;
  if ((p - knob()).norm() <= r) return Handle::ring;
  if ((p - pivot).norm() <= centre_radius * scale) return Handle::centre;
  if ((p - pin()).norm() <= pin_radius * scale) return Handle::pivot;
  for (const int axis : {0, 1})
    if (distance_to_segment(p, shaft(axis), tip(axis) + 0.3 * r * direction(axis)) <= 0.7 * r)
      return axis == 0 ? Handle::arrow_x : Handle::arrow_y;
  const double off_ring = std::abs((p - pivot).norm() - radius);
  return off_ring <= 0.7 * r ? Handle::ring : Handle::none;
}

Gizmo make_gizmo(const View& view, const Vec2& pivot, double reach, double turned, double scale) {
  const ScreenVector size = view.viewport().size();
  const double room = 0.42 * std::min(size.x(), size.y());
  Gizmo gizmo;
  gizmo.pivot = view.to_screen(pivot);
  // Seen from afar the ring stays large enough to take, seen from near within the window.
  gizmo.radius = std::max(smallest_ring * scale,
                          std::min(reach / view.pixel_size(pivot) + ring_gap * scale, room));
  gizmo.angle = pi / 4 + radians(turned);
  gizmo.scale = scale;
  return gizmo;
}

}  // namespace winslow::gui
