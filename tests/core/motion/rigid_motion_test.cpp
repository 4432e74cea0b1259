#include "core/motion/rigid_motion.h"

#include <doctest/doctest.h>

namespace winslow {

TEST_CASE("composed rigid motions act one after the other") {
  const RigidMotion first{30, Vec2(1, 2), Vec2(0.5, -0.25)};
  for (const RigidMotion& second :
       {RigidMotion{-75, Vec2(-3, 0.5), Vec2(0.1, 0.2)}, RigidMotion{0, Vec2(9, 9), Vec2(1, 1)}}) {
    const RigidMotion total = compose(first, second);
    for (const Vec2& p : {Vec2(0, 0), Vec2(4, -1), Vec2(-2, 7)}) {
      CHECK((transform(total, p) - transform(second, transform(first, p))).norm() < 1e-12);
      CHECK((transform_back(first, transform(first, p)) - p).norm() < 1e-12);
    }
  }
  CHECK(compose({0, {0, 0}, {1, 0}}, {0, {5, 5}, {0, 1}}).rotate == 0);
}

}  // namespace winslow
