#include "core/mesh/place_text.h"

#include <doctest/doctest.h>

#include <limits>

using namespace winslow;

TEST_CASE("places are said in as many digits as it takes to find them") {
  CHECK(place_text(Vec2(0, 0)) == "(0, 0)");
  CHECK(place_text(Vec2(0.25, -1.0 / 3)) == "(0.25, -0.333333)");
  CHECK(place_text(Vec2(1000, -300)) == "(1000, -300)");
  CHECK(place_text(Vec2(1e7 + 0.125, -3e7)) == "(10000000.125, -30000000)");
  CHECK(place_text(Vec2(-1e200, 1)) == "(-9.9999999999999997e+199, 1)");
  CHECK(place_text(Vec2(std::numeric_limits<double>::infinity(), 1)) == "(inf, 1)");
}
