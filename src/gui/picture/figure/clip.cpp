#include "gui/picture/figure/clip.h"

#include <algorithm>

namespace winslow::gui {

std::optional<std::array<ScreenPoint, 2>> clip_line(const ScreenPoint& a, const ScreenPoint& b,
                                                    const ScreenBox& box) {
  // Liang and Barsky: the line is a + t (b - a); each side narrows the range of t.
  const ScreenVector d = b - a;
  double first = 0;
  double last = 1;
  for (const int axis : {0, 1}) {
    for (const auto& [direction, distance] : {std::pair{-d[axis], a[axis] - box.min[axis]},
                                              std::pair{d[axis], box.max[axis] - a[axis]}}) {
      if (direction == 0 && distance < 0) return std::nullopt;
      if (direction < 0) first = std::max(first, distance / direction);
      if (direction > 0) last = std::min(last, distance / direction);
    }
  }
  if (first > last) return std::nullopt;
  return std::array<ScreenPoint, 2>{ScreenPoint(a + first * d), ScreenPoint(a + last * d)};
}

std::vector<ScreenPoint> clip_polygon(std::vector<ScreenPoint> polygon, const ScreenBox& box) {
  // Sutherland and Hodgman: one side of the box after the other.
  for (const int axis : {0, 1})
    for (const bool upper : {false, true}) {
      const double limit = upper ? box.max[axis] : box.min[axis];
      const auto inside = [&](const ScreenPoint& p) {
        return upper ? p[axis] <= limit : p[axis] >= limit;
      };
      std::vector<ScreenPoint> kept;
      for (std::size_t k = 0; k < polygon.size(); ++k) {
        const ScreenPoint& p = polygon[k];
        const ScreenPoint& q = polygon[(k + 1) % polygon.size()];
        if (inside(p)) kept.push_back(p);
        if (inside(p) != inside(q))
          kept.emplace_back(p + (limit - p[axis]) / (q[axis] - p[axis]) * (q - p));
      }
      polygon = std::move(kept);
    }
  return polygon;
}

}  // namespace winslow::gui
