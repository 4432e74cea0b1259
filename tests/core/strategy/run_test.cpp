#include "core/strategy/run.h"

#include <doctest/doctest.h>

namespace winslow::test {
namespace {

SmoothResult ended_by(Stage stage) {
  SmoothResult result;
  result.converged = false;
  result.out_of_iterations = false;
  result.inverted = 0;
  result.fraction_reached = 1;
  result.history.emplace_back().stage = Stage::relax;
  result.history.emplace_back().stage = stage;
  return result;
}

}  // namespace

TEST_CASE("a valid run that Newton's method ended before its limit gains no more") {
  SmoothResult result = ended_by(Stage::newton);
  CHECK(gains_no_more(result));
  // To raise the worst element afterwards changes nothing about that.
  result.history.emplace_back().stage = Stage::worst;
  CHECK(gains_no_more(result));
  result.out_of_iterations = true;
  CHECK(!gains_no_more(result));
  result = ended_by(Stage::newton);
  result.converged = true;
  CHECK(!gains_no_more(result));
  result = ended_by(Stage::newton);
  result.inverted = 1;
  CHECK(!gains_no_more(result));
  result = ended_by(Stage::newton);
  result.fraction_reached = 0.5;
  CHECK(!gains_no_more(result));
  CHECK(!gains_no_more(ended_by(Stage::untangle)));
  CHECK(!gains_no_more(SmoothResult{}));
}

}  // namespace winslow::test
