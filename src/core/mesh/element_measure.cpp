#include "core/mesh/element_measure.h"

#include <Eigen/Geometry>

namespace winslow {

namespace {

double triple(const Vec3& a, const Vec3& b, const Vec3& c) { return a.dot(b.cross(c)); }

}  // namespace

double signed_area2(const Coordinates& x, std::span<const Index> corners) {
  const Vec2 o = x.xy(corners[0]);
  double sum = 0;
  for (std::size_t k = 1; k + 1 < corners.size(); ++k) {
    const Vec2 a = x.xy(corners[k]) - o;
    const Vec2 b = x.xy(corners[k + 1]) - o;
    sum += a.x() * b.y() - a.y() * b.x();
  }
  return sum;
}

double signed_volume6(const Coordinates& x, ElementType type, std::span<const Index> corners,
                      const Vec3& origin) {
  double sum = 0;
  for (const Face& face : shape_of(type).faces) {
    const Face nodes = by_nodes(face, corners);
    const Vec3 a = x.xyz(nodes[0]) - origin, b = x.xyz(nodes[1]) - origin,
               c = x.xyz(nodes[2]) - origin;
    if (nodes.size() == 3) {
      sum += triple(a, b, c);
      continue;
    }
    // The mean over both ways to cut the quadrilateral into triangles.
    const Vec3 d = x.xyz(nodes[3]) - origin;
    sum += 0.5 * (triple(a, b, c) + triple(a, c, d) + triple(a, b, d) + triple(b, c, d));
  }
  return sum;
}

}  // namespace winslow
