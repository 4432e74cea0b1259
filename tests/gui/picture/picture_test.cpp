#include "gui/picture/picture.h"

#include <doctest/doctest.h>

#include "core/error.h"
#include "gui/support/pixels.h"
#include "gui/support/scene.h"
#include "support/meshes.h"

using namespace winslow;
using namespace winslow::gui;
using gui::test::color_at;
using gui::test::distance;
using gui::test::inked;
using winslow::test::Cells;

namespace {

PictureOptions small() {
  PictureOptions options;
  options.width = 480;
  options.height = 360;
  return options;
}

}  // namespace

TEST_CASE("A picture shows the mesh on white, or on dark") {
  const Mesh mesh = make_mesh(winslow::test::square_with_hole(10, Cells::triangles));
  PictureOptions options = small();
  const Image light = draw_picture(mesh, options);
  CHECK(light.width == 480);
  CHECK(light.height == 360);
  CHECK(light.rgba.size() == 4u * 480 * 360);
  CHECK(distance(color_at(light, {1, 1}), {1, 1, 1}) < 0.01);
  CHECK(inked(light, 100, 60, 380, 300) > 1000);
  options.dark = true;
  const Image dark = draw_picture(mesh, options);
  CHECK(color_at(dark, {1, 1})[0] < 0.2);
}

TEST_CASE("Colours come with a legend on the right, which can be left out") {
  const Mesh mesh = make_mesh(winslow::test::square(6, Cells::quads));
  PictureOptions options = small();
  options.color = Metric::normalized_jacobian;
  const Image with = draw_picture(mesh, options);
  options.legend = false;
  const Image without = draw_picture(mesh, options);
  // The colours of the bar's ends: none of them is in a mesh of squares.
  const auto has_color = [](const Image& image, const Rgb& color) {
    for (int y = 0; y < image.height; ++y) {
      for (int x = image.width / 2; x < image.width; ++x) {
        if (distance(color_at(image, ScreenPoint(x, y)), color) < 0.02) return true;
      }
    }
    return false;
  };
  CHECK(has_color(with, sample_color_map("neutral", 0.01)));
  CHECK(has_color(with, sample_color_map("neutral", 0.5)));
  CHECK_FALSE(has_color(without, sample_color_map("neutral", 0.5)));
  // All corners are right angles: sine 1, the bright end.
  CHECK(has_color(without, sample_color_map("neutral", 1)));
}

TEST_CASE("Title and marker key are drawn in the margins") {
  const Mesh mesh = make_mesh(winslow::test::square(6, Cells::quads));
  PictureOptions options = small();
  options.marker_key = false;
  CHECK(inked(draw_picture(mesh, options), 0, 335, 50, 360) == 0);
  options.marker_key = true;
  options.title = "Case E";
  const Image image = draw_picture(mesh, options);
  CHECK(inked(image, 10, 5, 100, 30) > 50);
  CHECK(inked(image, 0, 335, 50, 360) > 50);
}

TEST_CASE("Bounds are shown whole, whatever the shape of the picture") {
  const Mesh mesh = make_mesh(winslow::test::square(10, Cells::quads));
  PictureOptions options = small();
  options.marker_key = false;
  options.wireframe = false;
  options.color = Metric::area;
  options.colors.range = {0.0, 0.01};
  options.legend = false;
  options.width = 600;
  options.height = 200;
  options.bounds = Bounds{{0.9, 0.2}, {1.1, 0.8}};
  const Image image = draw_picture(mesh, options);
  // 0.6 units in 200 pixels less two margins of 12: the right side of the mesh is in the middle.
  const Rgb full = sample_color_map("viridis", 1);
  CHECK(distance(color_at(image, {290, 100}), full) < 0.01);
  CHECK(distance(color_at(image, {310, 100}), {1, 1, 1}) < 0.01);
  CHECK(distance(color_at(image, {290, 20}), full) < 0.01);
  CHECK(distance(color_at(image, {290, 180}), full) < 0.01);
}

TEST_CASE("Inverted elements are red and counted") {
  Mesh mesh = make_mesh(winslow::test::regular_star(6));
  PictureOptions options = small();
  options.marker_key = false;
  const Image valid = draw_picture(mesh, options);
  mesh.coordinates.set_xy(0, {1.2, 0.7});
  const Image tangled = draw_picture(mesh, options);
  const auto red_pixels = [](const Image& image, int y0, int y1) {
    int count = 0;
    for (int y = y0; y < y1; ++y) {
      for (int x = 0; x < image.width; ++x) {
        const auto* p = image.pixel(x, y);
        if (p[0] > 150 && p[1] < 60 && p[2] < 70) ++count;
      }
    }
    return count;
  };
  CHECK(red_pixels(valid, 0, 360) == 0);
  CHECK(red_pixels(tangled, 0, 330) > 500);
  CHECK(red_pixels(tangled, 335, 360) > 20);
}

TEST_CASE("The same picture comes out twice") {
  const Mesh mesh = make_mesh(winslow::test::annulus(24, 6, 1.2, Cells::mixed));
  PictureOptions options = small();
  options.color = Metric::aspect_ratio;
  CHECK(draw_picture(mesh, options).rgba == draw_picture(mesh, options).rgba);
}

TEST_CASE("A tiny picture holds the mesh alone") {
  const Mesh mesh = make_mesh(winslow::test::square(2, Cells::quads));
  PictureOptions options;
  options.width = 16;
  options.height = 8;
  options.title = "a title that cannot fit";
  options.color = Metric::normalized_jacobian;
  const Image image = draw_picture(mesh, options);
  CHECK(image.width == 16);
  CHECK(inked(image, 5, 2, 11, 6) > 0);
}

TEST_CASE("Options that make no picture are refused") {
  const Mesh mesh = make_mesh(winslow::test::square(2, Cells::quads));
  PictureOptions options = small();
  options.bounds = Bounds{{1, 0}, {0, 1}};
  CHECK_THROWS_AS(draw_picture(mesh, options), UsageError);
  options = small();
  options.colors.range = {1.0, 1.0};
  CHECK_THROWS_AS(draw_picture(mesh, options), UsageError);
  options = small();
  options.color = Metric::area;
  options.colors.map = "rainbow";
  CHECK_THROWS_AS(draw_picture(mesh, options), UsageError);
  options = small();
  options.width = 0;
  CHECK_THROWS_AS(draw_picture(mesh, options), UsageError);
}
