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
  CHECK(compose(RigidMotion{0, {0, 0}, {1, 0}}, {0, {5, 5}, {0, 1}}).rotate == 0);
}

TEST_CASE("bodies turn about the centre of their bounding box, without rounding errors of 0") {
  CHECK(body_centre(Bounds{Vec2(-1, 2), Vec2(3, 3)}) == Vec2(1, 2.5));
  CHECK(body_centre(Bounds{Vec2(-1 + 1e-14, 2), Vec2(1, 3)}) == Vec2(0, 2.5));
  CHECK(body_centre(Bounds{Vec2(-1 + 1e-6, 2), Vec2(1, 3)}).x() == doctest::Approx(5e-7));
  // Far away it is what it is: the extent says what is small.
  CHECK(body_centre(Bounds{Vec2(1e7, -1), Vec2(1e7 + 1, 1)}) == Vec2(1e7 + 0.5, 0));
}

TEST_CASE("a motion that is asked for without a pivot turns about the centre that it is given") {
  RigidMotionRequest open;
  open.rotate = 30;
  open.translate = Vec2(1, 2);
  CHECK(same_motion(open.about({5, 6}), {30, Vec2(5, 6), Vec2(1, 2)}));
  const RigidMotionRequest named{30, Vec2(0, 0), Vec2(1, 2)};
  CHECK(same_motion(named.about({5, 6}), {30, Vec2(0, 0), Vec2(1, 2)}));
  CHECK_FALSE(open == named);
}

}  // namespace winslow
