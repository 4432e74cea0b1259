#include <algorithm>
#include <cmath>

#include "core/motion/facet.h"

namespace winslow {

namespace {

double cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

double distance(const Vec2& p, const Facet<2>& s) {
  const Vec2 along = s[1] - s[0];
  const double length = along.squaredNorm();
  const double t = length > 0 ? std::clamp(along.dot(p - s[0]) / length, 0.0, 1.0) : 0.0;
  return (p - (s[0] + t * along)).norm();
}

}  // namespace

Meeting<2> meeting(const Facet<2>& s, const Facet<2>& t) {
  const Vec2 along = s[1] - s[0], other = t[1] - t[0];
  // Nodes in one place are not always so to the last bit after a motion.
  constexpr double round_off = 1e-12;
  const double least = round_off * along.norm() * other.norm();
  const auto side = [&](const Vec2& line, const Vec2& arm) {
    const double area = cross(line, arm);
    return std::abs(area) <= least ? 0 : area;
  };
  const double from = side(along, t[0] - s[0]), to = side(along, t[1] - s[0]);
  const double begin = side(other, s[0] - t[0]), end = side(other, s[1] - t[0]);
  if (from * to > 0 || begin * end > 0) return {};
  if (from * to < 0 && begin * end < 0)
    return {Meeting<2>::Kind::crossing, Vec2(s[0] + begin / (begin - end) * along)};
  for (const Vec2& p : s)
    if (distance(p, t) <= round_off * other.norm()) return {Meeting<2>::Kind::touch, p};
  for (const Vec2& p : t)
    if (distance(p, s) <= round_off * along.norm()) return {Meeting<2>::Kind::touch, p};
  return {};
}

double distance(const Facet<2>& s, const Facet<2>& t) {
  if (meeting(s, t).kind != Meeting<2>::Kind::none) return 0;
  return std::min({distance(s[0], t), distance(s[1], t), distance(t[0], s), distance(t[1], s)});
}

}  // namespace winslow
