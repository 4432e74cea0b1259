#include "gui/render/metric_scale.h"

#include <doctest/doctest.h>

#include <limits>
#include <numeric>

using namespace winslow;
using namespace winslow::gui;

TEST_CASE("The sine is shown from 0 to 1 whatever the mesh") {
  const std::vector<double> values{-0.5, 0.3, 0.8};
  const ColorScale scale = automatic_scale(Metric::normalized_jacobian, values);
  CHECK(scale.low == 0);
  CHECK(scale.high == 1);
  CHECK_FALSE(scale.reversed);
}

TEST_CASE("Fields with a sign have the middle of a diverging map at zero") {
  const std::vector<double> values{-0.5, 0.3, 0.8};
  for (const ElementField& field : all_element_fields()) {
    CAPTURE(field_info(field).name);
    const bool sign = field == Metric::normalized_jacobian || field == Metric::area ||
                      field == NodalField::smallest_weight;
    CHECK(automatic_scale(field, values, "puor").diverges() == sign);
    CHECK_FALSE(automatic_scale(field, values, "viridis").diverges());
  }
}

TEST_CASE("One sliver and inverted elements do not stretch the colours of the aspect ratio") {
  std::vector<double> values(1000, 1.0);
  for (std::size_t k = 0; k < values.size(); ++k) values[k] = 1.0 + static_cast<double>(k) / 1000;
  values[500] = 1e7;
  values[501] = std::numeric_limits<double>::infinity();
  const ColorScale scale = automatic_scale(Metric::aspect_ratio, values);
  CHECK(scale.low == 1);
  CHECK(scale.high == doctest::Approx(2));
  CHECK(scale.reversed);
}

TEST_CASE("A perfect mesh and an empty one have a range too") {
  const std::vector<double> perfect(10, 1.0);
  CHECK(automatic_scale(Metric::condition_number, perfect).high == doctest::Approx(1.5));
  CHECK(automatic_scale(Metric::condition_number, {}).high == doctest::Approx(1.5));
  const ColorScale area = automatic_scale(Metric::area, {});
  CHECK(area.high > area.low);
}

TEST_CASE("A histogram counts every finite value once, those out of range at the ends") {
  const ColorScale scale{"viridis", 0, 1, false, 0};
  const std::vector<double> values{
      -1, 0.05, 0.15, 0.15, 0.95, 1, 9, std::nan(""), std::numeric_limits<double>::infinity()};
  const Histogram histogram = histogram_over(values, scale, 10);
  REQUIRE(histogram.counts.size() == 10);
  CHECK(histogram.counts[0] == 2);
  CHECK(histogram.counts[1] == 2);
  CHECK(histogram.counts[9] == 3);
  CHECK(std::accumulate(histogram.counts.begin(), histogram.counts.end(), 0) == 7);
}
