#include "core/motion/body_ways.h"

#include <doctest/doctest.h>

#include "support/meshes.h"

using namespace winslow;

namespace {

MovingBody body(double rotate, const Vec2& pivot, const Vec2& translate = Vec2(0, 0)) {
  return {{"flap"}, {.rotate = rotate, .pivot = pivot, .translate = translate}};
}

MovingBody in_space(double rotate, const Vec3& axis) {
  return {{"flap"}, {.rotate = rotate, .pivot = Vec3(0, 0, 0), .axis = axis}};
}

using Bodies = std::vector<MovingBody>;

}  // namespace

TEST_CASE("the way between two poses leads from one to the other and keeps full turns") {
  const Bodies from{body(350, Vec2(1, 0.5), Vec2(0.1, 0))};
  const Bodies to{body(370, Vec2(1, 0.5), Vec2(0.1, 0.3))};
  const auto way = ways_between(from, to);
  REQUIRE(way);
  REQUIRE(way->size() == 1);
  CHECK(way->front().motion.rotate == doctest::Approx(20));
  CHECK(largest_turn(*way) == doctest::Approx(20));
  for (const Vec2& point : {Vec2(1, 0.5), Vec2(-2, 3)}) {
    const Vec2 there = transform(way->front().motion, transform(from.front().motion, point));
    CHECK((there - transform(to.front().motion, point)).norm() < 1e-14);
    // Halfway it has done half of the difference: both motions have the same pivot.
    const RigidMotion middle = body(360, Vec2(1, 0.5), Vec2(0.1, 0.15)).motion;
    const RigidMotion half = part_of_way(from, *way, 0.5).front().motion;
    CHECK((transform(half, point) - transform(middle, point)).norm() < 1e-14);
    CHECK(half.rotate == doctest::Approx(360));
  }
}

TEST_CASE("a body that only one of two poses moves is at rest in the other") {
  const Bodies one{body(10, Vec2(0, 0))};
  const Bodies other{{{"slat"}, body(-4, Vec2(3, 0)).motion}};
  const auto way = ways_between(one, other);
  REQUIRE(way);
  REQUIRE(way->size() == 2);
  CHECK(way->front().markers.front() == "slat");
  CHECK(way->front().motion.rotate == doctest::Approx(-4));
  CHECK(way->back().markers.front() == "flap");
  CHECK(way->back().motion.rotate == doctest::Approx(-10));
}

TEST_CASE("there is no way about different pivots, nor between markers joined otherwise") {
  CHECK_FALSE(ways_between(Bodies{body(10, Vec2(0, 0))}, Bodies{body(12, Vec2(1, 0))}));
  CHECK(ways_between(Bodies{body(0, Vec2(0, 0), Vec2(1, 0))}, Bodies{body(12, Vec2(1, 0))}));
  const Bodies both{{{"flap", "slat"}, body(5, Vec2(0, 0)).motion}};
  CHECK_FALSE(ways_between(both, Bodies{body(5, Vec2(0, 0))}));
  const Bodies turned_names{{{"slat", "flap"}, body(6, Vec2(0, 0)).motion}};
  CHECK(ways_between(both, turned_names));
}

TEST_CASE("axes that are not parallel have a way between small rotations only") {
  const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY();
  CHECK(ways_between(Bodies{in_space(20, x)}, Bodies{in_space(20, y)}));
  CHECK_FALSE(ways_between(Bodies{in_space(110, x)}, Bodies{in_space(110, y)}));
  CHECK_FALSE(ways_between(Bodies{in_space(350, x)}, Bodies{in_space(10, y)}));
  // The same axis the other way round.
  const auto way = ways_between(Bodies{in_space(200, x)}, Bodies{in_space(-230, -x)});
  REQUIRE(way);
  CHECK(largest_turn(*way) == doctest::Approx(30));
}

TEST_CASE("poses on one way are told from others") {
  const Bodies four{body(4, Vec2(1, 0), Vec2(0.2, 0))}, six{body(6, Vec2(1, 0), Vec2(0.3, 0))};
  CHECK(on_one_way(four, six));
  CHECK(on_one_way(six, Bodies{body(-6, Vec2(1, 0), Vec2(-0.3, 0))}));
  CHECK_FALSE(on_one_way(four, Bodies{body(6, Vec2(1, 0), Vec2(0.2, 0))}));
  CHECK_FALSE(on_one_way(four, Bodies{body(6, Vec2(2, 0), Vec2(0.3, 0))}));
  CHECK_FALSE(on_one_way(four, Bodies{four.front(), {{"slat"}, six.front().motion}}));
  // Both bodies have to be equally far on their ways.
  const Bodies half{four.front(), {{"slat"}, body(1, Vec2(0, 0)).motion}};
  CHECK(on_one_way(half, Bodies{six.front(), {{"slat"}, body(1.5, Vec2(0, 0)).motion}}));
  CHECK_FALSE(on_one_way(half, Bodies{six.front(), {{"slat"}, body(2, Vec2(0, 0)).motion}}));
}

TEST_CASE("the length of a way counts full turns") {
  const auto box = [](const MovingBody&) {
    Box<3> around = Box<3>::empty();
    around.add(Vec3(-1, 0, 0));
    around.add(Vec3(1, 0, 0));
    return around;
  };
  const Bodies rest{body(0, Vec2(0, 0))};
  const auto length = [&](const Bodies& to) {
    return longest_way(*ways_between(rest, to), rest, box);
  };
  CHECK(length({body(360, Vec2(0, 0))}) == doctest::Approx(2 * pi));
  CHECK(length({body(0, Vec2(0, 0), Vec2(3, 4))}) == doctest::Approx(5));
}
