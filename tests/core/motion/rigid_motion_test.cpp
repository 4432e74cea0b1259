#include "core/motion/rigid_motion.h"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <numeric>
#include <vector>

#include "support/random.h"

using namespace winslow;
using namespace winslow::test;

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

namespace {

Vec3 point_around(Random& random) {
  return {random.uniform(-2, 2), random.uniform(-2, 2), random.uniform(-2, 2)};
}

SpaceMotion random_motion(Random& random) {
  return {random.uniform(-170, 170), point_around(random), point_around(random),
          point_around(random)};
}

}  // namespace

TEST_CASE("a rotation in space turns counter-clockwise about its axis") {
  const SpaceMotion motion{90, Vec3(0, 0, 5), Vec3(1, 0, 0), Vec3(0, 0, 2)};
  CHECK((transform(motion, Vec3(2, 0, 0)) - Vec3(1, 1, 2)).norm() < 1e-15);
  CHECK((rotated(motion, Vec3(0, 1, 3)) - Vec3(-1, 0, 3)).norm() < 1e-15);
  CHECK(transform(SpaceMotion{0, Vec3(0, 0, 1), Vec3(0.1, 0.2, 0.3), Vec3::Zero()},
                  Vec3(1e-17, 0, 0)) == Vec3(1e-17, 0, 0));
}

TEST_CASE("composed motions in space act one after the other") {
  Random random(2);
  for (int sample = 0; sample < 50; ++sample) {
    SpaceMotion first = random_motion(random), second = random_motion(random);
    if (sample % 5 == 1) first.rotate = 0;
    if (sample % 5 == 2) second.rotate = 0;
    if (sample % 5 == 3) second.axis = -3 * first.axis;
    const SpaceMotion total = compose(first, second);
    for (int k = 0; k < 3; ++k) {
      const Vec3 p = point_around(random);
      CHECK((transform(total, p) - transform(second, transform(first, p))).norm() < 1e-12);
      CHECK((transform_back(first, transform(first, p)) - p).norm() < 1e-12);
      CHECK((transform(inverse(first), transform(first, p)) - p).norm() < 1e-12);
    }
  }
}

TEST_CASE("rotations about parallel axes keep their full turns") {
  const SpaceMotion first{300, Vec3(0, 1, 0), Vec3(1, 0, 0), Vec3::Zero()};
  CHECK(compose(first, first).rotate == 600);
  CHECK(compose(first, {40, Vec3(0, -2, 0), Vec3::Zero(), Vec3::Zero()}).rotate == 260);
  CHECK(compose(inverse(first), first).rotate == 0);
  CHECK(compose({0, Vec3(1, 0, 0), Vec3::Zero(), Vec3(1, 0, 0)},
                {0, Vec3(0, 0, 1), Vec3(5, 5, 5), Vec3(0, 1, 0)})
            .rotate == 0);
}

TEST_CASE("the motion that fits moved nodes is the one that moved them") {
  Random random(5);
  constexpr Index count = 12;
  std::vector<Index> nodes(count);
  std::iota(nodes.begin(), nodes.end(), 0);
  for (int sample = 0; sample < 20; ++sample) {
    Coordinates from(3, count), to(3, count);
    const SpaceMotion motion = random_motion(random);
    for (const Index node : nodes) {
      Vec3 p = point_around(random);
      if (sample % 4 == 1) p.z() = 0;  // in a plane
      from.set_xyz(node, p);
      to.set_xyz(node, transform(motion, p));
    }
    const SpaceMotion fitted = fit_space_motion(nodes, from, to);
    for (const Index node : nodes)
      CHECK((transform(fitted, from.xyz(node)) - to.xyz(node)).norm() < 1e-12);
    // Full turns are those of the motion that it is compared with.
    SpaceMotion turned = motion;
    turned.rotate += 720;
    const SpaceMotion same = with_turns(fitted, turned.axis, turned.rotate + 50);
    CHECK(same.rotate == doctest::Approx(turned.rotate));
    CHECK((same.axis - turned.axis).norm() == 0);
    CHECK((transform(same, from.xyz(0)) - to.xyz(0)).norm() < 1e-11);
  }
}
