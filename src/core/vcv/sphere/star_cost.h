#pragma once

#include <span>

#include "core/types.h"
#include "core/vcv/sphere/sphere_link.h"

namespace winslow {

/// Aspect ratio R / (3 r) of the tetrahedron 0 a b c, R and r the radii of its circumscribed and
/// its inscribed sphere: 1 of the regular one, infinite of a flat one. a . (b x c) must not be
/// negative.
double tetrahedron_aspect_ratio(const Vec3& a, const Vec3& b, const Vec3& c);

/// Cost of one tetrahedron 0 a b c of a VCV (AIAA 2009-1362, equation 3):
///
///   1 - J where J < 0, else 1 - 1 / (AR (1 + |alpha - theta|)^2),
///
/// J = a . (b x c), AR its aspect ratio, alpha its solid angle and theta the wanted one. The paper
/// prints alpha - theta without the bars, which would reward an angle that is too small.
double tetrahedron_cost(const Vec3& a, const Vec3& b, const Vec3& c, double wanted);

/// Cost of a vertex of the link (equation 4), of the costs c of the tetrahedra around it:
///
///   C* = r C_max + max(0, 1 - r) C,   r = C_max^3,   C the mean of c^2.
class BlendedCost {
 public:
  void add(double cost) {
    largest_ = cost > largest_ ? cost : largest_;
    squares_ += cost * cost;
    ++count_;
  }
  double value() const;

 private:
  double largest_ = 0, squares_ = 0;
  int count_ = 0;
};

/// Cost of a vertex. targets: #triangles, in steradians. directions: #vertices.
double vertex_cost(const SphereLink& link, Index vertex, std::span<const double> targets,
                   std::span<const Vec3> directions);

/// Costs of the vertices of a star.
struct StarCost {
  double min = 0, max = 0;
};
StarCost star_cost(const SphereLink& link, std::span<const double> targets,
                   std::span<const Vec3> directions);

}  // namespace winslow
