#include "gui/render/color_map.h"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <limits>
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
