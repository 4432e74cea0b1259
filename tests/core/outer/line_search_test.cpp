#include "core/outer/line_search.h"

#include <doctest/doctest.h>

using namespace winslow;

TEST_CASE("a longer step ends at the minimum of a parabola") {
  // phi(t) = 3 (t - 1.5)^2 + 7: slope -9 at 0, phi(1) - phi(0) = 0.75 - 6.75.
  CHECK(longer_step(9, -6) == doctest::Approx(1.5));
  // phi(t) = t^2 - t: the minimum lies before 1.
  CHECK(longer_step(1, 0) == doctest::Approx(0.5));
}

TEST_CASE("where the function is concave or straight there is no longer step") {
  CHECK(longer_step(2, -2) == 1);
  CHECK(longer_step(2, -3) == 1);
}
