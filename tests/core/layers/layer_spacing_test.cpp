#include "core/layers/layer_spacing.h"

#include <doctest/doctest.h>

#include <cmath>
#include <numeric>

#include "core/error.h"

using namespace winslow;

namespace {

double sum(const std::vector<double>& heights) {
  return std::accumulate(heights.begin(), heights.end(), 0.0);
}

}  // namespace

TEST_CASE("the paper's distribution: 15 layers, 0.001, 1.15, 1.01") {
  const auto heights = layer_heights({});
  REQUIRE(heights.size() == 15);
  CHECK(heights[0] == 0.001);
  double ratio = 1.15, height = 0.001;
  for (std::size_t k = 1; k < heights.size(); ++k) {
    height *= ratio;
    ratio *= 1.01;
    CHECK(heights[k] == doctest::Approx(height).epsilon(1e-12));
  }
  CHECK(heights.back() == doctest::Approx(0.0175).epsilon(2e-3));
  CHECK(sum(heights) == doctest::Approx(0.0797).epsilon(2e-3));
}

TEST_CASE("a total thickness gives the ratio, and the first height stays") {
  LayerSpacing spacing{20, 1e-4, 1.3, 1.0, 0.02, false};
  const auto heights = layer_heights(spacing);
  CHECK(sum(heights) == doctest::Approx(0.02).epsilon(1e-12));
  CHECK(heights[0] == 1e-4);
  const double ratio = heights[1] / heights[0];
  for (std::size_t k = 1; k < heights.size(); ++k) {
    CHECK(heights[k] / heights[k - 1] == doctest::Approx(ratio).epsilon(1e-10));
  }
  spacing.total = 1e-3;  // less than 20 times the first
  CHECK_THROWS_AS(layer_heights(spacing), UsageError);
}

TEST_CASE("less room makes ratios smaller first, then layers fewer") {
  const LayerSpacing spacing{10, 0.01, 1.2, 1.0, {}, false};
  const double whole = sum(layer_heights(spacing));
  const auto thin = layer_heights_within(spacing, 0.7 * whole);
  CHECK(thin.size() == 10);
  CHECK(thin[0] == 0.01);
  CHECK(sum(thin) == doctest::Approx(0.7 * whole).epsilon(1e-12));
  CHECK(thin.back() >= thin.front());
  const auto few = layer_heights_within(spacing, 0.055);
  CHECK(few.size() == 5);
  CHECK(sum(few) == doctest::Approx(0.05));
  CHECK(layer_heights_within(spacing, 0.009).empty());
}

TEST_CASE("the last layer can be given; the count follows from it") {
  const LayerSpacing spacing{12, 0.01, 1.2, 1.0, {}, false};
  const auto heights = layer_heights_ending_with(spacing, 0.05);
  CHECK(heights.front() == 0.01);
  CHECK(heights.back() == doctest::Approx(0.05).epsilon(1e-10));
  const int count = layers_until(spacing, 0.05);
  CHECK(0.01 * std::pow(1.2, count - 1) >= 0.05);
  CHECK(0.01 * std::pow(1.2, count - 2) < 0.05);
}

TEST_CASE("the first height of a y+, from the friction of a flat plate") {
  // Re = 1e6: C_f = 0.026 / 1e6^(1/7) = 0.0036125, u_tau/U = 0.0425, y = 1 / (1e6 0.0425).
  CHECK(first_height_for_y_plus(1, 1e6, 1) == doctest::Approx(2.353e-5).epsilon(1e-3));
  CHECK(first_height_for_y_plus(30, 1e6, 2) ==
        doctest::Approx(60 * first_height_for_y_plus(1, 1e6, 1)));
  CHECK_THROWS_AS(first_height_for_y_plus(0, 1e6, 1), UsageError);
  CHECK_THROWS_AS(first_height_for_y_plus(1, -1, 1), UsageError);
}

TEST_CASE("spacings that are out of range are refused") {
  for (LayerSpacing bad :
       {LayerSpacing{0}, LayerSpacing{5, -1}, LayerSpacing{5, 0.1, 0}, LayerSpacing{5, 0.1, 1.2, 9},
        LayerSpacing{5, 0.1, 1.2, 1, -1.0}, LayerSpacing{5, 0.1, 1.2, 1, 1.0, true}}) {
    CHECK_THROWS_AS(validate(bad), UsageError);
  }
}
