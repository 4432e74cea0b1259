#include "core/layers/space/ball_clearance.h"

#include <Eigen/Geometry>

#include "core/geometry/surface/triangulation.h"
#include "core/mesh/surface_faces.h"

namespace winslow {

Vec3 nearest_of_triangle(const Vec3& p, const std::array<Vec3, 3>& corners) {
  const auto& [a, b, c] = corners;
  const Vec3 ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c;
  const double d1 = ab.dot(ap), d2 = ac.dot(ap), d3 = ab.dot(bp), d4 = ac.dot(bp);
  const double d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d1 <= 0 && d2 <= 0) return a;
  if (d3 >= 0 && d4 <= d3) return b;
  if (d6 >= 0 && d5 <= d6) return c;
  const double of_c = d1 * d4 - d3 * d2, of_b = d5 * d2 - d1 * d6, of_a = d3 * d6 - d5 * d4;
  if (of_c <= 0 && d1 >= 0 && d3 <= 0) return a + d1 / (d1 - d3) * ab;
  if (of_b <= 0 && d2 >= 0 && d6 <= 0) return a + d2 / (d2 - d6) * ac;
  if (of_a <= 0 && d4 >= d3 && d5 >= d6) return b + (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (c - b);
  const double sum = of_a + of_b + of_c;
  return a + of_b / sum * ab + of_c / sum * ac;
}

BallClearance::BallClearance(const Mesh& mesh) : x_(mesh.coordinates) {
  const SpacePoints x(mesh.coordinates);
  std::vector<Box<3>> boxes;
  for (const SurfaceFace& face : boundary_faces(*mesh.topology)) {
    const std::vector<Index> nodes(face.nodes.begin(), face.nodes.end());
    for (const auto& cut : triangles_of(x, nodes)) {
      Triangle triangle;
      for (std::size_t k = 0; k < 3; ++k) {
        triangle.nodes[k] = nodes[at(cut[k])];
        triangle.corners[k] = x[triangle.nodes[k]];
      }
      const auto& [a, b, c] = triangle.corners;
      const Vec3 area = (c - a).cross(b - a);
      if (!(area.norm() > 0)) continue;
      triangle.normal = area.normalized();
      triangle.inside = face.neighbour >= 0;
      boxes.push_back(Box<3>::around(triangle.corners));
      triangles_.push_back(triangle);
    }
  }
  tree_ = BoxTree<3>(boxes);
}

double BallClearance::radius(Index node, const Vec3& inward, double reach) const {
  constexpr double facing = 0.3;  // cosine
  constexpr int most_balls = 50;
  constexpr double fine = 1e-3;  // relative change of the radius
  const Vec3 p = x_.xyz(node);
  double radius = reach;
  for (int ball = 0; ball < most_balls; ++ball) {
    const Vec3 centre = p + radius * inward;
    const auto distance = [&](Index t) {
      const Triangle& triangle = triangles_[at(t)];
      const double cosine = triangle.normal.dot(inward);
      const bool faces = cosine < -facing || (triangle.inside && cosine > facing);
      if (!faces || index_of(triangle.nodes, node) < 3)
        return std::numeric_limits<double>::infinity();
      return (nearest_of_triangle(centre, triangle.corners) - centre).norm();
    };
    const auto nearest = tree_.nearest(centre, radius, distance);
    if (!nearest || !(nearest->distance < radius)) break;
    const Vec3 q = nearest_of_triangle(centre, triangles_[at(nearest->item)].corners) - p;
    const double height = q.dot(inward);
    if (!(height > 0)) break;
    const double next = q.squaredNorm() / (2 * height);
    const bool done = next > radius * (1 - fine);
    radius = std::min(radius, next);
    if (done) break;
  }
  return radius;
}

}  // namespace winslow
