#include "core/strategy/smooth_options.h"

#include <doctest/doctest.h>

#include <limits>

#include "core/error.h"

using namespace winslow;

TEST_CASE("the default options are valid") { CHECK_NOTHROW(validate(SmoothOptions{})); }

TEST_CASE("options at the ends of their ranges are valid") {
  SmoothOptions options;
  options.damping = 1;
  options.acceleration = 0;
  options.max_iterations = 0;
  options.threads = 0;
  options.linear.max_iterations = 1;
  options.linear.restart = 1;
  CHECK_NOTHROW(validate(options));
}

TEST_CASE("options out of range are refused, naming the option") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  SmoothOptions options;
  std::string word;
  SUBCASE("formulation") {
    options.formulation = "magic";
    word = "formulation: found \"magic\", expected one of variational, pointwise";
  }
  SUBCASE("linear solver") {
    options.linear.solver = "magic";
    word = "linear.solver: found \"magic\", expected one of automatic, ";
  }
  SUBCASE("damping zero") {
    options.damping = 0;
    word = "damping";
  }
  SUBCASE("damping above one") {
    options.damping = 1.0001;
    word = "damping";
  }
  SUBCASE("damping NaN") {
    options.damping = nan;
    word = "damping";
  }
  SUBCASE("acceleration negative") {
    options.acceleration = -1;
    word = "acceleration";
  }
  SUBCASE("acceleration huge") {
    options.acceleration = 101;
    word = "acceleration";
  }
  SUBCASE("iterations") {
    options.max_iterations = -1;
    word = "max_iterations: found -1, expected 0 or more";
  }
  SUBCASE("tolerance zero") {
    options.tolerance = 0;
    word = "tolerance";
  }
  SUBCASE("tolerance one") {
    options.tolerance = 1;
    word = "tolerance";
  }
  SUBCASE("tolerance NaN") {
    options.tolerance = nan;
    word = "tolerance";
  }
  SUBCASE("threads") {
    options.threads = -1;
    word = "threads";
  }
  SUBCASE("linear tolerance") {
    options.linear.tolerance = nan;
    word = "linear.tolerance";
  }
  SUBCASE("linear iterations") {
    options.linear.max_iterations = 0;
    word = "linear.max_iterations: found 0, expected 1 or more";
  }
  SUBCASE("restart") {
    options.linear.restart = 0;
    word = "linear.restart";
  }
  try {
    validate(options);
    FAIL("accepted");
  } catch (const UsageError& error) {
    CHECK(std::string(error.what()).find(word) != std::string::npos);
  }
}
