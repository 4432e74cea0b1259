#include "gui/render/mesh_renderer.h"

#include <doctest/doctest.h>

#include <cmath>

#include "core/error.h"
#include "core/quality/quality.h"
#include "gui/render/gl.h"
#include "gui/support/scene.h"
#include "support/meshes.h"

using namespace winslow;
using namespace winslow::gui;
using namespace winslow::gui::test;
using winslow::test::Cells;

namespace {

MeshStyle fill_only() {
  MeshStyle style;
  style.wireframe = false;
  style.boundary_width = 0;
  return style;
}

MeshStyle lines_only(float width) {
  MeshStyle style;
  style.fill = false;
  style.edge_width = width;
  style.boundary_width = 0;
  style.edge_color = {0, 0, 0, 1};
  return style;
}

Vec2 centre_of(const Mesh& mesh, Index e) {
  Vec2 sum(0, 0);
  for (const Index node : mesh.topology->element(e)) sum += mesh.coordinates.xy(node);
  return sum / static_cast<double>(mesh.topology->element(e).size());
}

/// Two quadrilaterals side by side, [-1, 1] by [0, 1], the edge between them at x = middle.
Mesh two_quads(double middle) {
  MeshData data;
  for (const double x : {-1.0, middle, 1.0}) {
    data.coordinates.push_xy({x, 0});
    data.coordinates.push_xy({x, 1});
  }
  winslow::test::add_quad(data, 0, 2, 3, 1);
  winslow::test::add_quad(data, 2, 4, 5, 3);
  return make_mesh(data);
}

double mean_of_green(const Image& image) {
  double sum = 0;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) sum += image.pixel(x, y)[1] / 255.0;
  return sum / (image.width * image.height);
}

/// Mean of a view that cells x cells quadrilaterals of some pixels fill.
double mean_of_cells(int cells, double pixels, const MeshStyle& style) {
  Scene scene(static_cast<int>(cells * pixels));
  const Mesh mesh = make_mesh(winslow::test::square(cells, Cells::quads));
  scene.show(mesh);
  scene.camera.fit(bounds(mesh), 0);
  return mean_of_green(scene.draw(style));
}

}  // namespace

TEST_CASE("Where faint lines are very many, the surface is as dark as they would make it") {
  MeshStyle style;
  style.fill_color = {1, 1, 1, 1};
  style.edge_color = {0, 0, 0, 0.8f};
  style.boundary_width = 0;
  for (const bool fill : {true, false}) {
    style.fill = fill;
    for (const double pixels : {0.8, 1.2, 2.0, 2.7, 4.0}) {
      CAPTURE(pixels);
      // The larger mesh has more than many_lines, the smaller one has not.
      const double merged = mean_of_cells(300, pixels, style);
      const double drawn = mean_of_cells(60, pixels, style);
      CHECK(merged < 0.98);
      CHECK(std::abs(merged - drawn) < 0.04);
    }
  }
}

TEST_CASE("Every element has the colour of its value") {
  Scene scene;
  for (const auto cells : {Cells::triangles, Cells::quads, Cells::mixed}) {
    CAPTURE(winslow::test::name_of(cells));
    const Mesh mesh = make_mesh(winslow::test::square(4, cells));
    scene.show(mesh);
    std::vector<double> values;
    for (Index e = 0; e < mesh.topology->element_count(); ++e) values.push_back(e);
    ColorScale scale;
    scale.high = mesh.topology->element_count() - 1;
    scene.renderer.set_values(values, scale);
    const Image image = scene.draw(fill_only());
    for (Index e = 0; e < mesh.topology->element_count(); ++e) {
      CAPTURE(e);
      CHECK(distance(color_at(image, scene.camera.to_screen(centre_of(mesh, e))), scale.color(e)) <
            0.01);
    }
  }
}

TEST_CASE("Without values elements have the fill colour, outside them is the ground") {
  Scene scene;
  const Mesh mesh = make_mesh(winslow::test::square_with_hole(10, Cells::triangles));
  scene.show(mesh);
  MeshStyle style = fill_only();
  style.fill_color = {0.2f, 0.4f, 0.6f, 1};
  const Image image = scene.draw(style);
  CHECK(distance(color_at(image, scene.camera.to_screen({0.2, 0.2})), {0.2f, 0.4f, 0.6f}) < 0.01);
  CHECK(distance(color_at(image, scene.camera.to_screen({0.5, 0.5})), white) < 0.01);
  CHECK(distance(color_at(image, {2, 2}), white) < 0.01);

  std::vector<double> values(static_cast<std::size_t>(mesh.topology->element_count()), 1.0);
  scene.renderer.set_values(values, {});
  CHECK(distance(color_at(scene.draw(style), scene.camera.to_screen({0.2, 0.2})),
                 sample_color_map("viridis", 1)) < 0.01);
  scene.renderer.clear_values();
  CHECK(distance(color_at(scene.draw(style), scene.camera.to_screen({0.2, 0.2})),
                 {0.2f, 0.4f, 0.6f}) < 0.01);
}

TEST_CASE("Values that do not fit the mesh are refused") {
  Scene scene;
  scene.show(make_mesh(winslow::test::square(2, Cells::quads)));
  CHECK_THROWS_AS(scene.renderer.set_values(std::vector<double>{1, 2, 3}, {}), UsageError);
}

TEST_CASE("An inverted element is red, above the elements that it covers") {
  Scene scene;
  Mesh mesh = make_mesh(winslow::test::regular_star(6));
  // The middle node is pulled out through the edge from node 1 to node 2.
  mesh.coordinates.set_xy(0, {1.2, 0.7});
  REQUIRE(check_validity(*mesh.topology, mesh.coordinates).inverted == 1);
  scene.show(mesh);
  const MeshStyle style = fill_only();
  const Vec2 inside =
      (mesh.coordinates.xy(0) + mesh.coordinates.xy(1) + mesh.coordinates.xy(2)) / 3;
  const Rgb red{style.inverted_color[0], style.inverted_color[1], style.inverted_color[2]};
  CHECK(distance(color_at(scene.draw(style), scene.camera.to_screen(inside)), red) < 0.01);

  MeshStyle hidden = style;
  hidden.show_inverted = false;
  CHECK(distance(color_at(scene.draw(hidden), scene.camera.to_screen(inside)), red) > 0.2);

  mesh.coordinates.set_xy(0, {0, 0});
  scene.renderer.set_mesh(mesh.topology, mesh.coordinates);
  CHECK(distance(color_at(scene.draw(style), scene.camera.to_screen({0.6, 0.35})), red) > 0.2);
}

TEST_CASE("Lines are as wide as asked for, in the middle of their edge") {
  Scene scene(200, 4);
  const Mesh mesh = two_quads(0.0);
  scene.show(mesh);
  scene.renderer.set_marker_styles({{{0, 0, 0, 1}, 0.0f}});
  for (const float width : {0.5f, 1.0f, 2.0f, 5.0f, 9.0f}) {
    CAPTURE(width);
    const auto line = profile_of_row(scene.draw(lines_only(width)), 100, 50, 150);
    CHECK(line.width == doctest::Approx(width).epsilon(0.06));
    CHECK(std::abs(line.centre - 100) < 0.05);
  }
}

TEST_CASE("A millionfold zoom shows an edge where it is, also far from its ends") {
  Scene scene(200, 4);
  const double middle = 0.123456789012;
  const Mesh mesh = two_quads(middle);
  scene.show(mesh);
  scene.renderer.set_marker_styles({{{0, 0, 0, 1}, 0.0f}});
  const double whole_view = scene.camera.units_per_pixel();
  for (const double zoom : {1.0, 1e3, 1e6, 1e9}) {
    CAPTURE(zoom);
    const double units = whole_view / zoom;
    // The edge 30.25 pixels to the right of the middle of the picture.
    scene.camera.look_at({middle - 30.25 * units, 0.377}, units);
    const auto line = profile_of_row(scene.draw(lines_only(3)), 100, 90, 170);
    CHECK(line.width == doctest::Approx(3).epsilon(0.06));
    CHECK(std::abs(line.centre - 130.25) < 0.1);
    // Panned by less than the room around the view, and back out.
    scene.camera.pan({-60, 0});
    CHECK(std::abs(profile_of_row(scene.draw(lines_only(3)), 100, 40, 110).centre - 70.25) < 0.1);
  }
}

TEST_CASE("A millionfold zoom fills both sides of a slanted edge exactly") {
  Scene scene(200, 0);
  const Mesh mesh = make_mesh(winslow::test::square(1, Cells::triangles));
  scene.show(mesh);
  scene.renderer.set_values(std::vector<double>{0, 1}, {});
  scene.camera.look_at({0.7, 0.7}, 1e-9);
  const Image image = scene.draw(fill_only());
  // The diagonal runs from the lower left to the upper right corner of the picture.
  for (int k = 10; k < 190; k += 20) {
    CAPTURE(k);
    CHECK(distance(color_at(image, ScreenPoint(k + 3, 199 - k)), sample_color_map("viridis", 0)) <
          0.01);
    CHECK(distance(color_at(image, ScreenPoint(k - 3, 199 - k)), sample_color_map("viridis", 1)) <
          0.01);
  }
}

TEST_CASE("Lines fade as cells shrink, until only the colours remain") {
  Scene scene(100, 4);
  MeshStyle style;
  style.edge_color = {0, 0, 0, 1};
  style.fill_color = {1, 1, 1, 1};
  std::vector<double> dark;
  for (const Index cells : {10, 30, 100, 300}) {
    scene.show(make_mesh(winslow::test::square(cells, Cells::quads)));
    const Image image = scene.draw(style);
    double sum = 0;
    for (int y = 30; y < 70; ++y) {
      for (int x = 30; x < 70; ++x) sum += 1 - color_at(image, ScreenPoint(x, y))[1];
    }
    dark.push_back(sum / 1600);
  }
  // A line a pixel wide every 9 pixels, in two directions; every 3 pixels, fading; every 0.9; gone.
  CHECK(dark[0] == doctest::Approx(1 - std::pow(8.0 / 9.0, 2)).epsilon(0.15));
  CHECK(dark[1] > 0.1);
  CHECK(dark[1] < 0.4);
  CHECK(dark[2] > 0.02);
  CHECK(dark[2] < dark[1]);
  CHECK(dark[3] == 0);
}

TEST_CASE("Markers wear their own colour and width") {
  Scene scene;
  const Mesh mesh = make_mesh(winslow::test::square(4, Cells::quads));
  scene.show(mesh);
  std::vector<MeshRenderer::MarkerStyle> styles(4, {{0, 0, 0, 1}, 1});
  const Index right = *mesh.topology->markers().find("right");
  styles[static_cast<std::size_t>(right)] = {{0, 0.5f, 0, 1}, 7};
  scene.renderer.set_marker_styles(styles);
  MeshStyle style = fill_only();
  style.fill_color = {1, 1, 1, 1};
  const Image image = scene.draw(style);
  const ScreenPoint on_right = scene.camera.to_screen({1, 0.6});
  CHECK(distance(color_at(image, on_right), {0, 0.5f, 0}) < 0.01);
  CHECK(distance(color_at(image, on_right - ScreenVector(2.5, 0)), {0, 0.5f, 0}) < 0.01);
  CHECK(distance(color_at(image, on_right - ScreenVector(5, 0)), white) < 0.01);
  const ScreenPoint on_left = scene.camera.to_screen({0, 0.6});
  CHECK(distance(color_at(image, on_left - ScreenVector(2.5, 0)), white) < 0.01);
}

TEST_CASE("Nodes are drawn as points") {
  Scene scene;
  const Mesh mesh = make_mesh(winslow::test::square(2, Cells::quads));
  scene.show(mesh);
  MeshStyle style = fill_only();
  style.node_size = 8;
  style.edge_color = {0, 0, 1, 1};
  const Image image = scene.draw(style);
  CHECK(distance(color_at(image, scene.camera.to_screen({0.5, 0.5})), {0, 0, 1}) < 0.05);
  CHECK(distance(color_at(image, scene.camera.to_screen({0.5, 0.5}) + ScreenVector(6, 0)),
                 {0, 0, 1}) > 0.3);
}

TEST_CASE("With depth what lies nearer hides what lies behind, else what comes later does") {
  Scene scene;
  // A large square, and after it a small one before its middle.
  MeshData data;
  for (const double half : {1.0, 0.3}) {
    const auto first = static_cast<Index>(data.coordinates.size());
    for (const Vec2& corner : {Vec2(-1, -1), Vec2(1, -1), Vec2(1, 1), Vec2(-1, 1)})
      data.coordinates.push_xy(half * corner);
    winslow::test::add_triangle(data, first, first + 1, first + 2);
    winslow::test::add_triangle(data, first, first + 2, first + 3);
  }
  const Mesh mesh = make_mesh(data);
  const std::uint32_t red = 0xFF0000FF, green = 0xFF00FF00;
  const std::array<float, 3> is_red{1, 0, 0}, is_green{0, 1, 0};
  const auto draw = [&](bool depth_test, float large, float small) {
    PreparedMesh prepared = prepare_mesh(mesh.topology, mesh.coordinates);
    prepared.whole.depth_test = depth_test;
    prepared.whole.heights = {large, large, large, large, small, small, small, small};
    scene.renderer.set_mesh(std::move(prepared));
    scene.renderer.set_colors({red, red, green, green}, {});
    MeshStyle style;
    style.wireframe = false;
    style.boundary_width = 6;
    return scene.draw(style);
  };
  scene.camera.fit(bounds(mesh));
  const ScreenPoint middle = scene.camera.to_screen({0, 0});
  const ScreenPoint inner_rim = scene.camera.to_screen({0, -0.3});
  CHECK(glIsEnabled(GL_DEPTH_TEST) == GL_FALSE);
  CHECK(distance(color_at(draw(false, 0.5f, 0), middle), is_green) < 0.01);
  CHECK(distance(color_at(draw(true, 0.5f, 0), middle), is_red) < 0.01);
  CHECK(distance(color_at(draw(true, 0.5f, 0), inner_rim), is_red) < 0.01);
  CHECK(distance(color_at(draw(true, 0, 0.5f), middle), is_green) < 0.01);
  CHECK(distance(color_at(draw(true, 50, 0), middle), is_red) < 0.01);
  CHECK(glIsEnabled(GL_DEPTH_TEST) == GL_FALSE);
  CHECK(glGetError() == GL_NO_ERROR);
}

TEST_CASE("A list without heights is plane again after one with them") {
  Scene scene;
  const Mesh mesh = two_quads(0.2);
  scene.show(mesh);
  const Image plane = scene.draw(fill_only());
  PreparedMesh prepared = prepare_mesh(mesh.topology, mesh.coordinates);
  prepared.whole.heights.assign(static_cast<std::size_t>(mesh.coordinates.size()), 0.5f);
  scene.renderer.set_mesh(std::move(prepared));
  CHECK(scene.draw(fill_only()).rgba == plane.rgba);  // seen from above
  scene.renderer.set_mesh(mesh.topology, mesh.coordinates);
  CHECK(scene.draw(fill_only()).rgba == plane.rgba);
}

TEST_CASE("A mesh that moved is drawn where it is now, within its viewport only") {
  Scene scene;
  Mesh mesh = two_quads(0.0);
  scene.show(mesh);
  scene.camera.set_viewport(50, 50, 100, 100);
  scene.camera.fit(bounds(mesh), 0);
  const MeshStyle style = fill_only();
  const Image before = scene.draw(style);
  CHECK(distance(color_at(before, {60, 100}), white) > 0.03);
  CHECK(distance(color_at(before, {45, 100}), white) < 0.01);
  for (Index i = 0; i < mesh.coordinates.size(); ++i) {
    mesh.coordinates.set_xy(i, mesh.coordinates.xy(i) + Vec2(1, 0));
  }
  scene.renderer.set_mesh(mesh.topology, mesh.coordinates);
  const Image after = scene.draw(style);
  CHECK(distance(color_at(after, {90, 100}), white) < 0.01);
  CHECK(distance(color_at(after, {140, 100}), white) > 0.03);
  CHECK(distance(color_at(after, {160, 100}), white) < 0.01);
  CHECK(glGetError() == GL_NO_ERROR);
}
