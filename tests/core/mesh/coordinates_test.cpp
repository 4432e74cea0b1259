#include "core/mesh/coordinates.h"

#include <doctest/doctest.h>

#include <limits>

#include "core/error.h"

using namespace winslow;

TEST_CASE("points of the plane and of space are kept node after node") {
  Coordinates plane(2, 2);
  plane.set_xy(1, {3, 4});
  plane.push_xy({5, 6});
  CHECK(plane.size() == 3);
  CHECK(plane.xy(0) == Vec2(0, 0));
  CHECK(plane.xy(1) == Vec2(3, 4));
  CHECK(plane.values()[4] == 5);
  CHECK(PlanePoints(plane)[2] == Vec2(5, 6));

  Coordinates space(3, 1);
  space.push_xyz({1, 2, 3});
  space.set_xyz(0, {7, 8, 9});
  CHECK(space.size() == 2);
  CHECK(space.xyz(0) == Vec3(7, 8, 9));
  CHECK(space.xyz(1) == Vec3(1, 2, 3));
  CHECK(space.values()[5] == 3);
  CHECK(SpacePoints(space)[1] == Vec3(1, 2, 3));
}

TEST_CASE("a point is never read or written in another dimension than it has") {
  Coordinates plane(2, 3), space(3, 2);
  const char* flat = "found points of space, expected points of the plane";
  const char* deep = "found points of the plane, expected points of space";
  CHECK_THROWS_WITH_AS(space.xy(0), flat, UsageError);
  CHECK_THROWS_WITH_AS(space.set_xy(0, {1, 2}), flat, UsageError);
  CHECK_THROWS_WITH_AS(space.push_xy({1, 2}), flat, UsageError);
  CHECK_THROWS_WITH_AS(PlanePoints{space}, flat, UsageError);
  CHECK_THROWS_WITH_AS(plane.xyz(0), deep, UsageError);
  CHECK_THROWS_WITH_AS(plane.set_xyz(0, {1, 2, 3}), deep, UsageError);
  CHECK_THROWS_WITH_AS(plane.push_xyz({1, 2, 3}), deep, UsageError);
  CHECK_THROWS_WITH_AS(SpacePoints{plane}, deep, UsageError);
  CHECK(plane == Coordinates(2, 3));
  CHECK(space == Coordinates(3, 2));
}

TEST_CASE("coordinates have two or three dimensions") {
  for (const int dimension : {-1, 0, 1, 4}) CHECK_THROWS_AS(Coordinates(dimension, 1), UsageError);
}

TEST_CASE("places are said in as many digits as it takes to find them") {
  CHECK(place_text(Vec2(0, 0)) == "(0, 0)");
  CHECK(place_text(Vec2(0.25, -1.0 / 3)) == "(0.25, -0.333333)");
  CHECK(place_text(Vec2(1000, -300)) == "(1000, -300)");
  CHECK(place_text(Vec2(1e7 + 0.125, -3e7)) == "(10000000.125, -30000000)");
  CHECK(place_text(Vec2(-1e200, 1)) == "(-9.9999999999999997e+199, 1)");
  CHECK(place_text(Vec2(std::numeric_limits<double>::infinity(), 1)) == "(inf, 1)");
}
