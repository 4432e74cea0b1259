#include "core/geometry/surface/triangle_tree.h"

#include <Eigen/Geometry>
#include <limits>

namespace winslow {

namespace {

/// Barycentric coordinates of the place of a flat triangle that is nearest to a point (C. Ericson,
/// "Real-Time Collision Detection", 5.1.5).
Vec3 nearest_in_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c;
  const double d1 = ab.dot(ap), d2 = ac.dot(ap);
  if (d1 <= 0 && d2 <= 0) return {1, 0, 0};
  const double d3 = ab.dot(bp), d4 = ac.dot(bp);
  if (d3 >= 0 && d4 <= d3) return {0, 1, 0};
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return {1 - d1 / (d1 - d3), d1 / (d1 - d3), 0};
  const double d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d6 >= 0 && d5 <= d6) return {0, 0, 1};
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return {1 - d2 / (d2 - d6), 0, d2 / (d2 - d6)};
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
    const double t = (d4 - d3) / ((d4 - d3) + (d5 - d6));
    return {0, 1 - t, t};
  }
  const double sum = va + vb + vc;
  return {va / sum, vb / sum, vc / sum};
}

Vec3 nearest_in(const Triangulation& surface, Index triangle, const Vec3& point) {
  const auto& [a, b, c] = surface.triangles[at(triangle)];
  return nearest_in_triangle(point, surface.points[at(a)], surface.points[at(b)],
                             surface.points[at(c)]);
}

}  // namespace

Vec3 point_at(const Triangulation& surface, const TrianglePlace& place) {
  const auto& [a, b, c] = surface.triangles[at(place.triangle)];
  return place.at[0] * surface.points[at(a)] + place.at[1] * surface.points[at(b)] +
         place.at[2] * surface.points[at(c)];
}

TriangleTree::TriangleTree(const Triangulation& surface) {
  std::vector<Box<3>> boxes;
  boxes.reserve(surface.triangles.size());
  for (const auto& triangle : surface.triangles) {
    Box<3> box = Box<3>::empty();
    for (const Index corner : triangle) box.add(surface.points[at(corner)]);
    boxes.push_back(box);
  }
  tree_ = BoxTree<3>(boxes);
}

TrianglePlace TriangleTree::nearest(const Triangulation& surface, const Vec3& point) const {
  const auto distance = [&](Index t) {
    return (point_at(surface, {t, nearest_in(surface, t, point)}) - point).norm();
  };
  const auto found = tree_.nearest(point, std::numeric_limits<double>::infinity(), distance);
  return {found->item, nearest_in(surface, found->item, point)};
}

}  // namespace winslow
