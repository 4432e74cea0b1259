#include <Eigen/Geometry>
#include <algorithm>

#include "core/inspect/space/plane_section.h"

namespace winslow {

namespace {

/// Twice the area of a triangle, positive if it is counter-clockwise.
double doubled_area(const Vec2& a, const Vec2& b, const Vec2& c) {
  return (b - a).x() * (c - a).y() - (b - a).y() * (c - a).x();
}

/// The corner can be cut off: no other corner lies in its triangle.
bool is_ear(const std::vector<Vec2>& p, const std::vector<Index>& left, std::size_t k) {
  const std::size_t n = left.size();
  const Index a = left[(k + n - 1) % n], b = left[k], c = left[(k + 1) % n];
  if (doubled_area(p[at(a)], p[at(b)], p[at(c)]) <= 0) return false;
  return std::ranges::none_of(left, [&](Index other) {
    if (other == a || other == b || other == c) return false;
    const Vec2& q = p[at(other)];
    return doubled_area(p[at(a)], p[at(b)], q) >= 0 && doubled_area(p[at(b)], p[at(c)], q) >= 0 &&
           doubled_area(p[at(c)], p[at(a)], q) >= 0;
  });
}

}  // namespace

std::vector<Index> cut_polygon(std::span<const Vec3> corners, const Vec3& normal) {
  if (corners.size() == 3) return {0, 1, 2};
  const auto [u, v] = directions_in(normal);
  std::vector<Vec2> p;
  std::vector<Index> left;
  for (const Vec3& corner : corners) {
    const Vec3 r = corner - corners[0];
    left.push_back(static_cast<Index>(p.size()));
    p.emplace_back(u.dot(r), v.dot(r));
  }
  std::vector<Index> triangles;
  while (left.size() > 2) {
    const std::size_t n = left.size();
    std::size_t ear = 1;
    for (std::size_t k = 0; k < n; ++k) {
      const std::size_t candidate = (k + 1) % n;
      if (!is_ear(p, left, candidate)) continue;
      ear = candidate;
      break;
    }
    for (const std::size_t k : {ear + n - 1, ear, ear + 1}) triangles.push_back(left[k % n]);
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(ear));
  }
  return triangles;
}

}  // namespace winslow
