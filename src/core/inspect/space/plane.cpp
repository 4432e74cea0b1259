#include "core/inspect/space/plane.h"

#include <Eigen/Geometry>

#include "core/error.h"

namespace winslow {

Plane::Plane(const Vec3& point, const Vec3& normal) : point_(point), normal_(normal) {
  // The largest component first: its square may be more than a double holds.
  const double largest = normal.cwiseAbs().maxCoeff();
  if (!point.allFinite() || !normal.allFinite() || largest == 0)
    throw UsageError("a plane needs a point and a normal of finite numbers, the normal not 0 0 0");
  normal_ = (normal / largest).normalized();
}

std::array<Vec3, 2> directions_in(const Vec3& unit_normal) {
  Index smallest = 0;
  unit_normal.cwiseAbs().minCoeff(&smallest);
  const Vec3 first = unit_normal.cross(Vec3::Unit(smallest)).normalized();
  return {first, unit_normal.cross(first)};
}

}  // namespace winslow
