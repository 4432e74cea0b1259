#include "core/motion/rigid_motion.h"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <numeric>
#include <vector>

#include "core/error.h"
#include "support/random.h"

using namespace winslow;
using namespace winslow::test;

namespace winslow {

using test::Random;

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
  CHECK(compose(RigidMotion{0, Vec2(0, 0), {1, 0}}, {0, Vec2(5, 5), {0, 1}}).rotate == 0);
}

TEST_CASE("bodies turn about the centre of their bounding box, without rounding errors of 0") {
  const auto centre = [](const Vec2& low, const Vec2& high) {
    return body_centre({{low.x(), low.y(), 0}, {high.x(), high.y(), 0}});
  };
  CHECK(centre({-1, 2}, {3, 3}) == Vec3(1, 2.5, 0));
  CHECK(centre({-1 + 1e-14, 2}, {1, 3}) == Vec3(0, 2.5, 0));
  CHECK(centre({-1 + 1e-6, 2}, {1, 3}).x() == doctest::Approx(5e-7));
  // Far away it is what it is: the extent says what is small.
  CHECK(centre({1e7, -1}, {1e7 + 1, 1}) == Vec3(1e7 + 0.5, 0, 0));
}

TEST_CASE("a motion that is asked for without a pivot turns about the centre that it is given") {
  RigidMotion open{.rotate = 30, .translate = Vec2(1, 2)};
  CHECK(same_motion(resolve_motion(open, 2, {5, 6, 0}), {30, Vec2(5, 6), Vec2(1, 2)}));
  const RigidMotion named{30, Vec2(0, 0), Vec2(1, 2)};
  CHECK(same_motion(resolve_motion(named, 2, {5, 6, 0}), named));
  CHECK_FALSE(open == named);
  open.axis = Vec3(0, 2, 0);
  const RigidMotion in_space = resolve_motion(open, 3, {5, 6, 7});
  CHECK(*in_space.pivot == Vec3(5, 6, 7));
  CHECK(*in_space.axis == Vec3(0, 2, 0));
  CHECK(*resolve_motion({}, 3, {0, 0, 0}).axis == Vec3(0, 0, 1));
}

TEST_CASE("a motion is refused by a mesh of another dimension") {
  const char* of_space =
      "an axis or a third component: only for a volume mesh, and this is a plane mesh";
  const auto resolve = [](const RigidMotion& motion, int dimension) {
    return resolve_motion(motion, dimension, Vec3(0, 0, 0));
  };
  const GivenVector flat = GivenVector::of_three(Vec3(1, 2, 0));
  for (const RigidMotion& motion :
       {RigidMotion{.axis = Vec3(0, 0, 1)}, RigidMotion{.translate = flat},
        RigidMotion{.pivot = flat}, RigidMotion{.translate = Vec3(0, 0, 1)}})
    CHECK_THROWS_WITH_AS(resolve(motion, 2), of_space, UsageError);
  // What the program found may lie in the plane, and be typed with two numbers for space.
  CHECK_NOTHROW(resolve({.translate = Vec3(1, 2, 0)}, 2));
  CHECK(resolve({.translate = Vec2(1, 2)}, 3).translate == Vec3(1, 2, 0));
  CHECK_THROWS_WITH_AS(resolve({.rotate = 1}, 3), "a rotation in space needs an axis", UsageError);
  CHECK_THROWS_WITH_AS(resolve({.rotate = 1, .axis = Vec3(0, 0, 0)}, 3),
                       "the axis of the rotation has no length", UsageError);
  CHECK_THROWS_AS(resolve({.rotate = std::nan("")}, 2), UsageError);
}

namespace {

/// The motions of the plane in two components, as the results of plane meshes are made of them.
struct InPlane {
  double rotate = 0;
  Vec2 pivot{0, 0}, translate{0, 0};

  static Vec2 rotated(const Vec2& v, double degrees) {
    if (degrees == 0) return v;
    const double c = std::cos(radians(degrees)), s = std::sin(radians(degrees));
    return {c * v.x() - s * v.y(), s * v.x() + c * v.y()};
  }
  Vec2 transform(const Vec2& p) const { return pivot + rotated(p - pivot, rotate) + translate; }
  Vec2 back(const Vec2& p) const { return pivot + rotated(p - translate - pivot, -rotate); }
  InPlane then(const InPlane& second) const {
    InPlane total{rotate + second.rotate, pivot, translate + second.translate};
    if (second.rotate == 0) return total;
    total.pivot = back(second.pivot);
    total.translate = second.pivot - total.pivot + second.translate;
    return total;
  }
  InPlane inverse() const { return {-rotate, pivot + translate, -translate}; }
};

void check_same_bits(const RigidMotion& motion, const InPlane& expected) {
  CHECK(motion.rotate == expected.rotate);
  CHECK(*motion.pivot == Vec3(expected.pivot.x(), expected.pivot.y(), 0));
  CHECK(motion.translate == Vec3(expected.translate.x(), expected.translate.y(), 0));
  CHECK_FALSE(motion.axis);
}

}  // namespace

TEST_CASE("motions of the plane are those of two components, bit by bit") {
  Random random(7);
  const auto number = [&] { return random.uniform(-3, 3); };
  const auto sample = [&](int k) {
    return InPlane{k % 4 == 0 ? 0 : 100 * number(), {number(), number()}, {number(), number()}};
  };
  for (int k = 0; k < 200; ++k) {
    const InPlane a = sample(k), b = sample(k / 3);
    const RigidMotion first{a.rotate, a.pivot, a.translate}, second{b.rotate, b.pivot, b.translate};
    check_same_bits(compose(first, second), a.then(b));
    check_same_bits(compose(inverse(first), second), a.inverse().then(b));
    check_same_bits(inverse(first), a.inverse());
    const Vec2 p(number(), number());
    CHECK(transform(first, p) == a.transform(p));
    CHECK(transform_back(first, p) == a.back(p));
  }
}

TEST_CASE("the fit of plane nodes is the least-squares rotation about their mean, bit by bit") {
  Random random(11);
  const auto number = [&] { return random.uniform(-3, 3); };
  for (int k = 0; k < 20; ++k) {
    constexpr Index count = 9;
    Coordinates from(2, count), to(2, count);
    std::vector<Index> nodes;
    const RigidMotion motion{60 * number(), Vec2(number(), number()), Vec2(number(), number())};
    Vec2 centre(0, 0), target(0, 0);
    for (Index i = 0; i < count; ++i) {
      nodes.push_back(i);
      from.set_xy(i, Vec2(number(), number()));
      to.set_xy(i, transform(motion, from.xy(i)) + 1e-3 * Vec2(number(), number()));
      centre += from.xy(i);
      target += to.xy(i);
    }
    centre /= count;
    target /= count;
    double cosine = 0, sine = 0;
    for (const Index node : nodes) {
      const Vec2 a = from.xy(node) - centre, b = to.xy(node) - target;
      cosine += a.dot(b);
      sine += a.x() * b.y() - a.y() * b.x();
    }
    check_same_bits(fit_rigid_motion(nodes, from, to),
                    {degrees(std::atan2(sine, cosine)), centre, target - centre});
  }
}

}  // namespace winslow

namespace {

Vec3 point_around(Random& random) {
  return {random.uniform(-2, 2), random.uniform(-2, 2), random.uniform(-2, 2)};
}

RigidMotion random_motion(Random& random) {
  const double rotate = random.uniform(-170, 170);
  const Vec3 axis = point_around(random), pivot = point_around(random);
  return {rotate, pivot, point_around(random), axis};
}

}  // namespace

TEST_CASE("a rotation in space turns counter-clockwise about its axis") {
  const RigidMotion motion{90, Vec3(1, 0, 0), Vec3(0, 0, 2), Vec3(0, 0, 5)};
  CHECK((transform(motion, Vec3(2, 0, 0)) - Vec3(1, 1, 2)).norm() < 1e-15);
  CHECK((rotated(motion, Vec3(0, 1, 3)) - Vec3(-1, 0, 3)).norm() < 1e-15);
  CHECK(transform(RigidMotion{0, Vec3(0.1, 0.2, 0.3), Vec3(0, 0, 0), Vec3(0, 0, 1)},
                  Vec3(1e-17, 0, 0)) == Vec3(1e-17, 0, 0));
}

TEST_CASE("composed motions in space act one after the other") {
  Random random(2);
  for (int sample = 0; sample < 50; ++sample) {
    RigidMotion first = random_motion(random), second = random_motion(random);
    if (sample % 5 == 1) first.rotate = 0;
    if (sample % 5 == 2) second.rotate = 0;
    if (sample % 5 == 3) second.axis = -3 * *first.axis;
    const RigidMotion total = compose(first, second);
    for (int k = 0; k < 3; ++k) {
      const Vec3 p = point_around(random);
      CHECK((transform(total, p) - transform(second, transform(first, p))).norm() < 1e-12);
      CHECK((transform_back(first, transform(first, p)) - p).norm() < 1e-12);
      CHECK((transform(inverse(first), transform(first, p)) - p).norm() < 1e-12);
    }
  }
}

TEST_CASE("rotations about parallel axes keep their full turns") {
  const RigidMotion first{300, Vec3(1, 0, 0), Vec3(0, 0, 0), Vec3(0, 1, 0)};
  CHECK(compose(first, first).rotate == 600);
  CHECK(compose(first, {40, Vec3(0, 0, 0), Vec3(0, 0, 0), Vec3(0, -2, 0)}).rotate == 260);
  CHECK(compose(inverse(first), first).rotate == 0);
  CHECK(compose({0, Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 0, 0)},
                {0, Vec3(5, 5, 5), Vec3(0, 1, 0), Vec3(0, 0, 1)})
            .rotate == 0);
}

TEST_CASE("the motion that fits moved nodes is the one that moved them") {
  Random random(5);
  constexpr Index count = 12;
  std::vector<Index> nodes(count);
  std::iota(nodes.begin(), nodes.end(), 0);
  for (int sample = 0; sample < 20; ++sample) {
    Coordinates from(3, count), to(3, count);
    const RigidMotion motion = random_motion(random);
    for (const Index node : nodes) {
      Vec3 p = point_around(random);
      if (sample % 4 == 1) p.z() = 0;  // in a plane
      from.set_xyz(node, p);
      to.set_xyz(node, transform(motion, p));
    }
    const RigidMotion fitted = fit_rigid_motion(nodes, from, to);
    for (const Index node : nodes)
      CHECK((transform(fitted, from.xyz(node)) - to.xyz(node)).norm() < 1e-12);
    // Full turns are those of the motion that it is compared with.
    RigidMotion turned = motion;
    turned.rotate += 720;
    const RigidMotion same = with_turns(fitted, turned, turned.rotate + 50);
    CHECK(same.rotate == doctest::Approx(turned.rotate));
    CHECK(*same.axis == *turned.axis);
    CHECK((transform(same, from.xyz(0)) - to.xyz(0)).norm() < 1e-11);
  }
}
