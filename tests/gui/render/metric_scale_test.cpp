#include "gui/render/metric_scale.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

using namespace winslow;
using namespace winslow::gui;

TEST_CASE("The sine is shown from 0 to 1 whatever the mesh") {
  const std::vector<double> values{-0.5, 0.3, 0.8};
  const ColorScale scale = color_scale(Metric::normalized_jacobian, values, {});
  CHECK(scale.low == 0);
  CHECK(scale.high == 1);
  CHECK_FALSE(scale.reversed);
}

TEST_CASE("Fields with a sign, and ratios, have the middle of a diverging map at zero or one") {
  const std::vector<double> values{-0.5, 0.3, 0.8};
  for (const ElementField& field : all_element_fields()) {
    CAPTURE(field_info(field).name);
    const bool sign = field == Metric::normalized_jacobian || field == Metric::area ||
                      field == NodalField::smallest_weight ||
                      field == WallField::first_height_ratio;
    CHECK(color_scale(field, values, {.map = "puor"}).diverges() == sign);
    CHECK_FALSE(color_scale(field, values, {.map = "viridis"}).diverges());
  }
}

TEST_CASE("A ratio of which 1 is best has it in the middle of its colours, well inside") {
  std::vector<double> values(300, 1.0);
  std::fill_n(values.begin(), 100, 0.25);
  std::fill_n(values.rbegin(), 100, 1.6);
  const ColorScale changed = color_scale(WallField::first_height_ratio, values, {});
  CHECK(changed.map == "puor");
  CHECK(changed.centre == 1);
  CHECK(changed.low <= 0.25);
  CHECK(changed.high >= 1.6);
  CHECK(changed.share(1) > 0);
  const ColorScale same = color_scale(WallField::first_height_ratio, std::vector{1.0, 1.0}, {});
  CHECK(same.low < 0.95);
  CHECK(same.high > 1.05);
  CHECK(color_scale(WallField::first_height_ratio, {}, {}).high > 1);
}

TEST_CASE("One sliver and inverted elements do not stretch the colours of the aspect ratio") {
  std::vector<double> values(1000, 1.0);
  for (std::size_t k = 0; k < values.size(); ++k) values[k] = 1.0 + static_cast<double>(k) / 1000;
  values[500] = 1e7;
  values[501] = std::numeric_limits<double>::infinity();
  const ColorScale scale = color_scale(Metric::aspect_ratio, values, {});
  CHECK(scale.low == 1);
  CHECK(scale.high == doctest::Approx(2));
  CHECK(scale.reversed);
}

TEST_CASE("A perfect mesh and an empty one have a range too") {
  const std::vector<double> perfect(10, 1.0);
  CHECK(color_scale(Metric::condition_number, perfect, {}).high == doctest::Approx(1.5));
  CHECK(color_scale(Metric::condition_number, {}, {}).high == doctest::Approx(1.5));
  const ColorScale area = color_scale(Metric::area, {}, {});
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

namespace {

/// Aspect ratios of a mesh with boundary layers: half of the elements near 1, the others up to
/// thousands.
std::vector<double> stretched() {
  std::vector<double> values;
  for (int k = 0; k < 1000; ++k) values.push_back(1 + 0.5 * k / 1000);
  for (int k = 0; k < 1000; ++k) values.push_back(std::pow(10.0, 4.0 * k / 1000));
  return values;
}

/// Number of tenths of the legend that hold at least two in a hundred of the values.
int tenths_used(std::span<const double> values, const ColorScale& scale) {
  const Histogram histogram = histogram_over(values, scale, 10);
  int used = 0;
  for (const Index count : histogram.counts)
    used += static_cast<std::size_t>(count) > values.size() / 50;
  return used;
}

}  // namespace

TEST_CASE("Stretched meshes show structure with no option given") {
  const std::vector<double> values = stretched();
  const ColorScale aspect = color_scale(Metric::aspect_ratio, values, {});
  CHECK(aspect.by_ratio());
  CHECK(aspect.low == 1);
  CHECK(tenths_used(values, aspect) >= 8);
  CHECK(aspect.map == "viridis");
  const ColorScale linear = color_scale(Metric::aspect_ratio, values, {.axis = ColorAxis::linear});
  CHECK_FALSE(linear.by_ratio());
  CHECK(tenths_used(values, linear) <= 6);
  std::vector<double> areas;
  for (int k = 0; k < 1000; ++k) areas.push_back(std::pow(10.0, -9.0 + 8.0 * k / 1000));
  areas.push_back(-1);  // an inverted element
  const ColorScale area = color_scale(Metric::area, areas, {});
  CHECK(area.by_ratio());
  CHECK(area.low > 0);
  CHECK(tenths_used(areas, area) == 10);
  // Not where values are of one size, nor of angles.
  CHECK_FALSE(color_scale(Metric::aspect_ratio, std::vector<double>{1, 1.2, 2, 3}, {}).by_ratio());
  CHECK_FALSE(color_scale(Metric::smallest_angle, values, {}).by_ratio());
}

TEST_CASE("A range by percentiles leaves out as many values as it says") {
  std::vector<double> values;
  for (int k = 0; k <= 1000; ++k) values.push_back(k);
  const ColorScale scale =
      color_scale(Metric::area, values, {.axis = ColorAxis::linear, .percentiles = {{1, 99}}});
  CHECK(scale.low == 10);
  CHECK(scale.high == 990);
  const ColorScale all =
      color_scale(Metric::normalized_jacobian, values, {.percentiles = {{0, 100}}});
  CHECK(all.low == 0);
  CHECK(all.high == 1000);
  // A range by its ends goes before it.
  CHECK(color_scale(Metric::area, values, {.percentiles = {{1, 99}}, .range = {{3, 5}}}).high == 5);
}

TEST_CASE("A logarithmic scale needs positive values") {
  const std::vector<double> some{-2, 0, 0.001, 0.01, 10};
  const ColorScale scale = color_scale(Metric::area, some, {.axis = ColorAxis::logarithmic});
  REQUIRE(scale.by_ratio());
  CHECK(scale.share(-2) == 0);
  CHECK(scale.share(scale.value_at(0.3)) == doctest::Approx(0.3));
  const std::vector<double> none{-3, -2, 0};
  CHECK_FALSE(color_scale(Metric::area, none, {.axis = ColorAxis::logarithmic}).by_ratio());
}

TEST_CASE("The automatic map is neutral for quality, where good elements recede into the ground") {
  CHECK(color_map_for(Metric::normalized_jacobian, "automatic") == "neutral");
  CHECK(color_map_for(Metric::aspect_ratio, "automatic") == "neutral");
  CHECK(color_map_for(Metric::area, "automatic") == "viridis");
  CHECK(color_map_for(LayerField::layer, "automatic") == "viridis");
  CHECK(color_map_for(Metric::aspect_ratio, "magma") == "magma");
  const std::vector<double> sines{0.1, 0.87, 0.87};
  for (const bool dark : {false, true}) {
    const ColorScale scale = color_scale(Metric::normalized_jacobian, sines, {.on_dark = dark});
    const auto away = [&](double sine) {
      float sum = 0;
      for (const float c : scale.color(sine)) sum += std::abs(c - (dark ? 0.1f : 1.0f));
      return sum / 3;
    };
    CHECK(away(0.87) < 0.15f);
    CHECK(away(0.1) > 0.5f);
  }
}
