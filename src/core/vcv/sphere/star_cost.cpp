#include "core/vcv/sphere/star_cost.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/vcv/sphere/solid_angle.h"

namespace winslow {

double tetrahedron_aspect_ratio(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 bc = b.cross(c), ca = c.cross(a), ab = a.cross(b);
  const double volume6 = a.dot(bc);
  if (!(volume6 > 0)) return std::numeric_limits<double>::infinity();
  // The circumcentre x has x . p = |p|^2 / 2 for each corner p; r = 3 V / (surface).
  const double circumradius =
      (a.squaredNorm() * bc + b.squaredNorm() * ca + c.squaredNorm() * ab).norm() / (2 * volume6);
  const double surface2 = bc.norm() + ca.norm() + ab.norm() + (b - a).cross(c - a).norm();
  return circumradius * surface2 / (3 * volume6);
}

double tetrahedron_cost(const Vec3& a, const Vec3& b, const Vec3& c, double wanted) {
  const double jacobian = a.dot(b.cross(c));
  if (jacobian < 0) return 1 - jacobian;
  const double off = 1 + std::abs(solid_angle(a, b, c) - wanted);
  return 1 - 1 / (tetrahedron_aspect_ratio(a, b, c) * off * off);
}

double BlendedCost::value() const {
  if (count_ == 0) return 0;
  const double r = largest_ * largest_ * largest_;
  return r * largest_ + std::max(0.0, 1 - r) * squares_ / count_;
}

double vertex_cost(const SphereLink& link, Index vertex, std::span<const double> targets,
                   std::span<const Vec3> directions) {
  BlendedCost cost;
  for (const Index h : link.outgoing(vertex)) {
    const auto [a, b, c] = link.triangles()[at(h / 3)];
    cost.add(tetrahedron_cost(directions[at(a)], directions[at(b)], directions[at(c)],
                              targets[at(h / 3)]));
  }
  return cost.value();
}

StarCost star_cost(const SphereLink& link, std::span<const double> targets,
                   std::span<const Vec3> directions) {
  StarCost cost{std::numeric_limits<double>::infinity(), 0};
  for (Index v = 0; v < link.vertex_count(); ++v) {
    const double own = vertex_cost(link, v, targets, directions);
    cost.min = std::min(cost.min, own);
    cost.max = std::max(cost.max, own);
  }
  return cost;
}

}  // namespace winslow
