#include "gui/view/navigation/in_view.h"

#include <algorithm>

namespace winslow::gui {

namespace {

/// A segment and a box have a point in common (Liang and Barsky).
bool crosses(const Vec2& a, const Vec2& b, const Bounds& box) {
  double from = 0, to = 1;
  for (int axis = 0; axis < 2; ++axis) {
    const double by = b[axis] - a[axis];
    double near = box.min[axis] - a[axis], far = box.max[axis] - a[axis];
    if (by == 0) {
      if (near > 0 || far < 0) return false;
      continue;
    }
    near /= by;
    far /= by;
    from = std::max(from, std::min(near, far));
    to = std::min(to, std::max(near, far));
    if (from > to) return false;
  }
  return true;
}

/// The segment crosses the ray from p to the right.
bool right_of(const Vec2& p, const Vec2& a, const Vec2& b) {
  if ((a.y() > p.y()) == (b.y() > p.y())) return false;
  return a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x()) > p.x();
}

}  // namespace

bool anything_in_view(const Topology& topology, const Coordinates& coordinates, const Bounds& box) {
  const Vec2 middle = box.centre();
  bool inside = false;
  for (const auto& loop : topology.boundary_loops()) {
    for (std::size_t k = 0; k < loop.size(); ++k) {
      const Vec2 a = coordinates.xy(loop[k]);
      const Vec2 b = coordinates.xy(loop[(k + 1) % loop.size()]);
      if (crosses(a, b, box)) return true;
      if (right_of(middle, a, b)) inside = !inside;
    }
  }
  return inside;
}

}  // namespace winslow::gui
