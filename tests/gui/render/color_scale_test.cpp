#include "gui/render/color_scale.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>

#include "core/error.h"

using namespace winslow;
using namespace winslow::gui;

namespace {

double luminance(const Rgb& c) {
  const auto linear = [](double v) { return std::pow(v, 2.2); };
  return 0.2126 * linear(c[0]) + 0.7152 * linear(c[1]) + 0.0722 * linear(c[2]);
}

int byte(float v) { return static_cast<int>(std::lround(255 * v)); }

}  // namespace

TEST_CASE("Maps start and end at their published colours") {
  const Rgb first = sample_color_map("viridis", 0);
  CHECK(byte(first[0]) == 0x44);
  CHECK(byte(first[1]) == 0x01);
  CHECK(byte(first[2]) == 0x54);
  const Rgb last = sample_color_map("viridis", 1);
  CHECK(byte(last[0]) == 0xFD);
  CHECK(byte(last[1]) == 0xE7);
  CHECK(byte(last[2]) == 0x25);
  // The middle of the published table of 256 colours: #21918C.
  const Rgb middle = sample_color_map("viridis", 0.5);
  CHECK(std::abs(byte(middle[0]) - 0x21) <= 4);
  CHECK(std::abs(byte(middle[1]) - 0x91) <= 4);
  CHECK(std::abs(byte(middle[2]) - 0x8C) <= 4);
}

TEST_CASE("Sequential maps grow brighter from end to end, so that they can be read without hues") {
  int sequential = 0;
  for (const std::string& name : color_map_names()) {
    CAPTURE(name);
    if (is_diverging(name)) continue;
    ++sequential;
    double before = luminance(sample_color_map(name, 0));
    for (int k = 1; k <= 100; ++k) {
      const double now = luminance(sample_color_map(name, k / 100.0));
      CHECK(now > before - 1e-3);
      before = now;
    }
    CHECK(before > luminance(sample_color_map(name, 0)) + 0.5);
  }
  CHECK(sequential == 7);
}

TEST_CASE("The diverging map is brightest in its middle, and its sides differ to every eye") {
  REQUIRE(is_diverging("puor"));
  for (const double side : {-1.0, 1.0}) {
    double before = luminance(sample_color_map("puor", 0.5));
    CHECK(before > 0.9);
    for (int k = 1; k <= 50; ++k) {
      const double now = luminance(sample_color_map("puor", 0.5 + side * k / 100.0));
      CHECK(now < before + 1e-3);
      before = now;
    }
    CHECK(before < 0.1);
  }
  // Machado, Oliveira, Fernandes 2009: what protanopes, deuteranopes and tritanopes see.
  const std::array<std::array<double, 9>, 3> eyes{
      {{0.152286, 1.052583, -0.204868, 0.114503, 0.786281, 0.099216, -0.003882, -0.048116,
        1.051998},
       {0.367322, 0.860646, -0.227968, 0.280085, 0.672501, 0.047413, -0.011820, 0.042940, 0.968881},
       {1.255528, -0.076749, -0.178779, -0.078411, 0.930809, 0.147602, 0.004733, 0.691367,
        0.303900}}};
  for (const auto& eye : eyes)
    for (int k = 15; k <= 50; ++k) {
      const Rgb a = sample_color_map("puor", 0.5 - k / 100.0);
      const Rgb b = sample_color_map("puor", 0.5 + k / 100.0);
      double distance = 0;
      for (std::size_t row = 0; row < 3; ++row) {
        double d = 0;
        for (std::size_t c = 0; c < 3; ++c)
          d += eye[3 * row + c] * static_cast<double>(a[c] - b[c]);
        distance += d * d;
      }
      CAPTURE(k);
      CHECK(std::sqrt(distance) > 0.2);
    }
}

TEST_CASE("A diverging map has its middle at the centre, half of it on each side") {
  ColorScale scale{"puor", -0.1, 1, false, 0, 0.0};
  const auto at = [](double t) { return sample_color_map("puor", t); };
  CHECK(scale.color(0) == at(0.5));
  CHECK(scale.color(-0.1) == at(0));
  CHECK(scale.color(-7) == at(0));
  CHECK(scale.color(-0.05) == at(0.25));
  CHECK(scale.color(0.5) == at(0.75));
  CHECK(scale.color(1) == at(1));
  // No value of one sign looks like the other, whatever the range.
  scale.low = 0;
  CHECK(scale.color(0.001)[2] > scale.color(0.001)[0] - 0.01f);
  CHECK(scale.color(-1e-9) == at(0));
  CHECK(scale.color(0) == at(0.5));
  scale.low = -0.1;
  for (const int bands : {2, 4, 5, 8, 20}) {
    scale.bands = bands;
    CHECK(scale.color(-1e-6) != scale.color(1e-6));
    CHECK(scale.color(1) == at(1));
    CHECK(scale.color(-0.1) == at(0));
  }
  CHECK(scale.strips(300) == 300);
  // Other maps take no notice.
  scale.map = "viridis";
  scale.bands = 5;
  CHECK(scale.color(0.45) == sample_color_map("viridis", 0.5));
  CHECK(scale.strips(300) == 5);
}

TEST_CASE("A map is clamped at its ends, and an unknown one is named together with the known") {
  CHECK(sample_color_map("cividis", -3) == sample_color_map("cividis", 0));
  CHECK(sample_color_map("cividis", 7) == sample_color_map("cividis", 1));
  CHECK_THROWS_WITH_AS(
      sample_color_map("jet", 0.5),
      "unknown colour map 'jet'; known: neutral viridis cividis glacier plasma magma "
      "inferno puor",
      UsageError);
}

TEST_CASE("A scale maps its range to the map, reversed if wanted") {
  ColorScale scale{"viridis", 2, 4, false, 0};
  CHECK(scale.color(2) == sample_color_map("viridis", 0));
  CHECK(scale.color(3) == sample_color_map("viridis", 0.5));
  CHECK(scale.color(100) == sample_color_map("viridis", 1));
  CHECK(scale.color(std::numeric_limits<double>::infinity()) == sample_color_map("viridis", 1));
  scale.reversed = true;
  CHECK(scale.color(2) == sample_color_map("viridis", 1));
  CHECK(scale.color(4) == sample_color_map("viridis", 0));
}

TEST_CASE("Bands are as many colours as asked for, both ends of the map among them") {
  const ColorScale scale{"viridis", 0, 1, false, 4};
  std::set<Rgb> colors;
  for (int k = 0; k <= 1000; ++k) colors.insert(scale.color(k / 1000.0));
  CHECK(colors.size() == 4);
  CHECK(colors.contains(sample_color_map("viridis", 0)));
  CHECK(colors.contains(sample_color_map("viridis", 1)));
  CHECK(scale.color(0.24) == scale.color(0.01));
  CHECK(scale.color(0.26) != scale.color(0.24));
}

TEST_CASE("What is no number is grey, and a range without extent does not divide by zero") {
  const ColorScale flat{"viridis", 1, 1, false, 0};
  CHECK(flat.color(1) == sample_color_map("viridis", 0));
  CHECK(flat.color(2) == sample_color_map("viridis", 1));
  const Rgb grey = flat.color(std::nan(""));
  CHECK(grey[0] == grey[1]);
  CHECK(grey[1] == grey[2]);
}

TEST_CASE("Neighbouring markers have different colours") {
  for (const bool dark : {false, true}) {
    std::set<Rgb> colors;
    for (Index m = 0; m < 8; ++m) colors.insert(marker_color(m, dark));
    CHECK(colors.size() == 8);
    CHECK(marker_color(8, dark) == marker_color(0, dark));
  }
}

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
