#include <doctest/doctest.h>

#include "core/error.h"
#include "gui/picture/space/volume_picture.h"
#include "gui/support/pixels.h"
#include "support/surface_meshes.h"

using namespace winslow;
using namespace winslow::gui;
using gui::test::differing;
using gui::test::inked;

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
