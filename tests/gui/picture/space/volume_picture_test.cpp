#include "gui/picture/space/volume_picture.h"

#include <doctest/doctest.h>

#include <Eigen/Geometry>

#include "core/error.h"
#include "gui/support/pixels.h"
#include "gui/support/scene.h"
#include "support/space_meshes.h"
#include "support/surface_meshes.h"

using namespace winslow;
using namespace winslow::gui;
using gui::test::color_at;
using gui::test::differing;
using gui::test::distance;
using gui::test::inked;
using winslow::test::Volumes;

namespace {

VolumePictureOptions small_volume() {
  VolumePictureOptions options;
  options.width = 480;
  options.height = 360;
  options.wireframe = false;
  options.legend = false;
  options.marker_key = false;
  return options;
}

Mesh body_in_box() { return make_mesh(winslow::test::cube_with_cavity(6, Volumes::mixed)); }

}  // namespace

TEST_CASE("A picture of a volume mesh is shown on white, or on dark, with its legend") {
  const Mesh mesh = body_in_box();
  VolumePictureOptions options = small_volume();
  options.wireframe = options.legend = options.marker_key = true;
  options.title = "Case";
  const Image light = draw_volume_picture(mesh, options);
  CHECK(light.width == 480);
  CHECK(distance(color_at(light, {1, 1}), {1, 1, 1}) < 0.01);
  CHECK(inked(light, 100, 60, 300, 300) > 5000);
  CHECK(inked(light, 10, 5, 100, 30) > 50);      // title
  CHECK(inked(light, 380, 60, 478, 320) > 500);  // legend
  CHECK(inked(light, 0, 338, 200, 360) > 100);   // what was cut, and the key
  CHECK(light.rgba == draw_volume_picture(mesh, options).rgba);
  options.dark = true;
  CHECK(color_at(draw_volume_picture(mesh, options), {1, 1})[0] < 0.2);
}

TEST_CASE("Around a body the mesh is cut through the body's middle, towards the viewer") {
  const Mesh mesh = body_in_box();
  const VolumeBoundary boundary = find_boundary(mesh);
  const auto cuts = automatic_cuts(mesh, boundary, automatic_view({}));
  REQUIRE(cuts.size() == 1);
  CHECK((cuts[0].normal() - Vec3(0, -1, 0)).norm() < 1e-12);
  CHECK(cuts[0].distance({0.5, 0.5, 0.5}) == doctest::Approx(0));
  const auto from_above = automatic_cuts(mesh, boundary, named_view("+z"));
  CHECK((from_above.at(0).normal() - Vec3(0, 0, 1)).norm() < 1e-12);
  const Mesh solid = make_mesh(winslow::test::cube(3, Volumes::hexahedra));
  CHECK(automatic_cuts(solid, find_boundary(solid), automatic_view({})).empty());
  // What the picture shows of the default: the same as of the cut by name.
  VolumePictureOptions options = small_volume();
  const Image automatic = draw_volume_picture(mesh, options);
  options.cuts = cuts;
  CHECK(draw_volume_picture(mesh, options).rgba == automatic.rgba);
  options.cuts = std::vector<Plane>();
  CHECK(draw_volume_picture(mesh, options).rgba != automatic.rgba);
}

TEST_CASE("Cuts are looked at from their front") {
  for (const Vec3& normal : {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1), Vec3(0, 0, -1),
                             Vec3(-1, -1, 0.2), Vec3(1, 2, -3)}) {
    const std::vector<Plane> cuts{Plane({0, 0, 0}, normal)};
    CHECK(to_viewer(automatic_view(cuts)).dot(cuts[0].normal()) > 0.7);
  }
  for (const int up : {0, 1, 2}) {
    const std::vector<Plane> cuts{Plane({0, 0, 0}, {0, 1, 0})};
    CHECK(to_viewer(automatic_view(cuts, up)).y() > 0.7);
  }
  const std::vector<Plane> corner{Plane({0, 0, 0}, {1, 0, 0}), Plane({0, 0, 0}, {0, 1, 0}),
                                  Plane({0, 0, 0}, {0, 0, 1})};
  for (const Plane& cut : corner) CHECK(to_viewer(automatic_view(corner)).dot(cut.normal()) > 0.5);
}

TEST_CASE("Views by name look along their axes") {
  CHECK((to_viewer(named_view("+x")) - Vec3(1, 0, 0)).norm() < 1e-12);
  CHECK((to_viewer(named_view("-y")) - Vec3(0, -1, 0)).norm() < 1e-12);
  CHECK((to_viewer(named_view("-z")) - Vec3(0, 0, -1)).norm() < 1e-12);
  CHECK((to_viewer(named_view("iso")) - Vec3(1, -1, 1).normalized()).norm() < 1e-12);
  CHECK((to_viewer(named_view("iso", 1)) - Vec3(1, 1, 1).normalized()).norm() < 1e-12);
  CHECK((to_viewer(named_view("+z", 1)) - Vec3(0, 0, 1)).norm() < 1e-12);
  CHECK(view_names().size() == 7);
  CHECK_THROWS_AS(named_view("front"), UsageError);
}

TEST_CASE("The middle of the picture and half its width are what was asked for") {
  const Mesh mesh = make_mesh(winslow::test::cube(4, Volumes::hexahedra));
  VolumePictureOptions options = small_volume();
  options.view = named_view("-y");
  options.color.reset();
  options.centre = Vec3(1, 0.5, 0.5);  // the right side of the cube
  options.half_width = 0.5;
  const Image image = draw_volume_picture(mesh, options);
  CHECK(distance(color_at(image, {225, 180}), {1, 1, 1}) > 0.02);
  CHECK(distance(color_at(image, {255, 180}), {1, 1, 1}) < 0.01);
  // The cube's left side lies a width away: beyond the left margin.
  CHECK(distance(color_at(image, {20, 180}), {1, 1, 1}) > 0.02);
}

TEST_CASE("Inverted elements of a volume mesh are red and counted") {
  Mesh mesh = make_mesh(winslow::test::cube(4, Volumes::tetrahedra));
  VolumePictureOptions options = small_volume();
  const auto red_pixels = [](const Image& image, int y0, int y1) {
    int count = 0;
    for (int y = y0; y < y1; ++y)
      for (int x = 0; x < image.width; ++x) {
        const auto* p = image.pixel(x, y);
        count += p[0] > p[1] + 40 && p[0] > p[2] + 40 ? 1 : 0;
      }
    return count;
  };
  CHECK(red_pixels(draw_volume_picture(mesh, options), 0, 360) == 0);
  const Index node = mesh.topology->interior_nodes()[13];
  mesh.coordinates.set_xyz(node, mesh.coordinates.xyz(node) + Vec3(0.4, 0, 0));
  const Image tangled = draw_volume_picture(mesh, options);
  CHECK(red_pixels(tangled, 0, 330) > 200);   // seen through the surface
  CHECK(red_pixels(tangled, 338, 360) > 20);  // the caption
}

TEST_CASE("Elements worse than a value are isolated") {
  Mesh mesh = make_mesh(winslow::test::cube(4, Volumes::hexahedra));
  const Index node = mesh.topology->interior_nodes()[0];
  mesh.coordinates.set_xyz(node, mesh.coordinates.xyz(node) + Vec3(0.1, 0.1, 0.1));
  VolumePictureOptions options = small_volume();
  const int whole = inked(draw_volume_picture(mesh, options), 80, 20, 400, 320);
  options.isolate = 0.95;
  const int some = inked(draw_volume_picture(mesh, options), 80, 20, 400, 320);
  options.isolate = 0.0;
  const int none = inked(draw_volume_picture(mesh, options), 80, 20, 400, 320);
  CHECK(none < some - 300);
  CHECK(some < 0.6 * whole);
}

TEST_CASE("Every metric of volume elements colours a picture, and only those") {
  const Mesh mesh = body_in_box();
  VolumePictureOptions options = small_volume();
  options.legend = true;
  options.cuts = cuts_of_picture(mesh, options);
  for (const ElementField& field : all_element_fields(MeshKind::volume)) {
    options.color = field;
    CHECK(inked(draw_volume_picture(mesh, options), 100, 60, 300, 300) > 5000);
  }
  CHECK_THROWS_AS(parse_field("area", MeshKind::volume), UsageError);
  CHECK(parse_field("smallest_solid_angle", MeshKind::volume).cell_dimension() == 3);
}

TEST_CASE("Heights at walls are shown on the bodies, which are coloured where nothing is cut") {
  const Mesh mesh = body_in_box();
  VolumePictureOptions options = small_volume();
  options.color = Metric::normalized_jacobian;
  CHECK(cuts_of_picture(mesh, options).size() == 1);
  options.color = WallField::size_ratio;
  CHECK(cuts_of_picture(mesh, options).size() == 1);
  for (const WallField field :
       {WallField::first_height, WallField::first_height_ratio, WallField::first_edge_tilt}) {
    options.color = field;
    CHECK(cuts_of_picture(mesh, options).empty());
  }
  options.color = WallField::first_height;
  VolumePictureOptions plain = options;
  plain.color.reset();
  plain.cuts = std::vector<Plane>{};
  CHECK(differing(draw_volume_picture(mesh, options), draw_volume_picture(mesh, plain), {0, 0},
                  {480, 360}) > 500);
}

TEST_CASE("What makes no picture of a volume mesh is refused") {
  const Mesh mesh = body_in_box();
  const auto refused = [&](auto&& change, const char* word) {
    VolumePictureOptions options = small_volume();
    change(options);
    try {
      draw_volume_picture(mesh, options);
      FAIL("not refused: ", word);
    } catch (const UsageError& error) {
      CHECK(std::string(error.what()).find(word) != std::string::npos);
    }
  };
  using O = VolumePictureOptions;
  refused([](O& o) { o.cuts = {Plane({0, 0, 3}, {0, 0, 1})}; }, "misses the mesh");
  refused(
      [](O& o) {
        o.cuts = std::vector<Plane>(7, Plane({.5, .5, .5}, {0, 0, 1}));
      },
      "at most 6");
  refused([](O& o) { o.hide = {"wing"}; }, "wing");
  refused([](O& o) { o.half_width = -1; }, "positive");
  refused([](O& o) { o.view = ViewDirection{0, 91}; }, "-90 to 90");
  refused([](O& o) { o.colors.map = "rainbow"; }, "rainbow");
  refused([](O& o) { o.width = 0; }, "between 1 and");
  refused([](O& o) { o.color.reset(), o.isolate = 0.5; }, "metric");
  const Mesh plane = make_mesh(winslow::test::square(2, winslow::test::Cells::quads));
  CHECK_THROWS_AS(draw_volume_picture(plane, small_volume()), UsageError);
}

namespace {

VolumePictureOptions small_surface() {
  VolumePictureOptions options;
  options.width = 400;
  options.height = 300;
  options.color = ElementField(Metric::normalized_jacobian);
  options.legend = false;
  options.wireframe = false;
  return options;
}

Mesh ball() { return make_mesh(winslow::test::octasphere(6)); }

}  // namespace

TEST_CASE("A surface is drawn in colours of each of its fields, by its views") {
  const Mesh mesh = ball();
  VolumePictureOptions options = small_surface();
  for (const ElementField& field : all_element_fields(MeshKind::surface)) {
    options.color = field;
    CHECK(inked(draw_volume_picture(mesh, options), 60, 10, 340, 290) > 20000);
  }
  options.view = named_view("+x");
  const Image front = draw_volume_picture(mesh, options);
  options.half_width = 4;
  CHECK(differing(front, draw_volume_picture(mesh, options), {0, 0}, {400, 300}) > 10000);
  CHECK(volume_picture_figure(mesh, options).scene != nullptr);
}

TEST_CASE("Deviations are from the mesh that was given, elements are inverted by its shape") {
  const Mesh given = ball();
  Mesh mesh = given;
  const Index node = 40;
  mesh.coordinates.set_xyz(node, 1.3 * given.coordinates.xyz(node));
  VolumePictureOptions options = small_surface();
  options.color = ElementField(SurfaceField::deviation);
  options.given = std::make_shared<const Mesh>(given);
  CHECK(volume_picture_scale(mesh, options).high >= 0.3);
  CHECK(volume_picture_scale(given, options).high < 0.3);
  // A node beyond its neighbours: some triangles face the wrong way, which is said below.
  Mesh tangled = given;
  tangled.coordinates.set_xyz(node, -given.coordinates.xyz(node));
  const Image sound = draw_volume_picture(given, options);
  const Image folded = draw_volume_picture(tangled, options);
  CHECK(differing(sound, folded, {0, 0}, {400, 300}) > 1000);
}

TEST_CASE("What makes no picture of a surface is refused") {
  const Mesh mesh = ball();
  const auto refused = [&](auto&& change) {
    VolumePictureOptions options = small_surface();
    change(options);
    CHECK_THROWS_AS(draw_volume_picture(mesh, options), UsageError);
  };
  refused([](VolumePictureOptions& o) { o.cuts = std::vector{Plane({0, 0, 0}, {0, 0, 1})}; });
  refused([](VolumePictureOptions& o) { o.vcvs = {3}; });
  refused([](VolumePictureOptions& o) { o.color = ElementField(Metric::volume, 3); });
  refused([](VolumePictureOptions& o) { o.color = ElementField(NodalField::kappa); });
}
