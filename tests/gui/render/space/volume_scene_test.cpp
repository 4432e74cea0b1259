#include "gui/render/space/volume_scene.h"

#include <doctest/doctest.h>

#include "core/error.h"
#include "core/inspect/space/plane_section.h"
#include "gui/support/scene.h"
#include "support/space_meshes.h"

using namespace winslow;
using namespace winslow::gui;
using namespace winslow::gui::test;
using winslow::test::all_volumes;
using winslow::test::Volumes;

namespace {

constexpr Rgb body_color{0.2f, 0.5f, 0.2f};

/// A colour for each element that tells it from its neighbours.
std::vector<std::uint32_t> colors_of(const Mesh& mesh) {
  std::vector<std::uint32_t> colors;
  for (Index e = 0; e < mesh.topology->element_count(); ++e) {
    const auto part = [&](Index k) { return static_cast<float>((e / k) % 5) / 5.0f; };
    colors.push_back(pack_color({part(1), part(5), part(25)}));
  }
  return colors;
}

Rgb unpacked(std::uint32_t rgba) {
  const auto part = [&](unsigned shift) {
    return static_cast<float>((rgba >> shift) & 255U) / 255.0f;
  };
  return {part(0), part(8), part(16)};
}

/// The mesh of a test with what stands around it, seen whole from -y.
struct Shown {
  explicit Shown(const MeshData& data)
      : mesh(make_mesh(data)), boundary(find_boundary(mesh)), colors(colors_of(mesh)) {
    look.edges = false;
    look.colors = colors;
    style.feature_width = 0;
    look.marker_colors.assign(mesh.topology->markers().size(), body_color);
    rig.camera.look_at({0.5, 0.5, 0.5}, 1.2 / 200);
  }
  Image draw() {
    const SpaceScene scene = build_scene(mesh, boundary, look, style);
    rig.camera.set_content(scene.extent);
    return rig.draw(scene);
  }

  SpaceRig rig;
  Mesh mesh;
  VolumeBoundary boundary;
  std::vector<std::uint32_t> colors;
  VolumeLook look;
  VolumeStyle style;
};

}  // namespace

TEST_CASE("Each polygon of a flat cut has the colour of its element") {
  for (const Volumes volumes : all_volumes) {
    CAPTURE(name_of(volumes));
    Shown shown(winslow::test::cube(4, volumes));
    const Plane plane({0.5, 0.43, 0.5}, {0.1, -1, 0.2});
    shown.look.cuts = {plane};
    const Image image = shown.draw();
    const PlaneSection section = plane_section(shown.mesh, plane);
    int compared = 0;
    for (Index k = 0; k < section.polygons.rows(); ++k) {
      Vec3 middle = Vec3::Zero();
      const auto corners = section.polygons[k];
      for (const Index p : corners)
        middle += section.points[at(p)] / static_cast<double>(corners.size());
      // Of large polygons, whose middle is more than a pixel away from the others.
      double nearest = 1;
      for (const Index p : corners)
        nearest = std::min(nearest, (section.points[at(p)] - middle).norm());
      if (nearest < 0.05) continue;
      ++compared;
      CHECK(distance(shown.rig.color(image, middle),
                     unpacked(shown.colors[at(section.elements[at(k)])])) < 0.02);
    }
    CHECK(compared > 10);
  }
}

TEST_CASE("A flat cut takes away what lies in front of it, of a solid body") {
  Shown shown(winslow::test::cube(4, Volumes::hexahedra));
  shown.look.cuts = {Plane({0.5, 0.5, 0.45}, {0, 0, 1})};
  const Image image = shown.draw();
  CHECK(distance(shown.rig.color(image, {0.4, 0, 0.5}), white) < 0.01);
  CHECK(distance(shown.rig.color(image, {0.4, 0, 0.4}), white) > 0.1);
}

TEST_CASE("Two cuts leave what lies behind both, and their sections end at each other") {
  Shown shown(winslow::test::cube(4, Volumes::hexahedra));
  shown.look.cuts = {Plane({0.5, 0.6, 0.5}, {0, -1, 0}), Plane({0.6, 0.5, 0.5}, {1, 0, 0})};
  const Image image = shown.draw();
  CHECK(distance(shown.rig.color(image, {0.9, 0.6, 0.5}), white) < 0.01);
  CHECK(distance(shown.rig.color(image, {0.3, 0.6, 0.4}), white) > 0.1);
}

TEST_CASE("A crinkled cut shows whole elements") {
  Shown shown(winslow::test::cube(4, Volumes::hexahedra));
  shown.look.cuts = {Plane({0.5, 0.5, 0.6}, {0, 0, 1})};
  shown.look.crinkle = true;
  shown.style.inverted = {1, 0, 0, 1};
  const Image image = shown.draw();
  CHECK(distance(shown.rig.color(image, {0.4, 0, 0.7}), white) > 0.1);  // up to 0.75
  CHECK(distance(shown.rig.color(image, {0.4, 0, 0.8}), white) < 0.01);
}

TEST_CASE("What encloses a body is an outline, and the body stands whole before a cut") {
  Shown shown(winslow::test::cube_with_cavity(6, Volumes::mixed));
  shown.style.feature_width = 2;
  shown.look.cuts = {Plane({0.5, 0.55, 0.5}, {0, -1, 0})};
  const Image image = shown.draw();
  REQUIRE(shown.boundary.encloses);
  // The cavity's side at y = 1/3 lies in front of the cut.
  const auto color = shown.rig.color(image, {0.43, 0.33, 0.43});
  CHECK(color[1] > 1.5 * color[0]);
  CHECK(color[1] > 1.5 * color[2]);
  CHECK(distance(shown.rig.color(image, {0.1, 0, 0.13}), white) > 0.1);  // the cut
  CHECK(distance(shown.rig.color(image, {0.3, 0, 1.0}), white) > 0.2);   // the outline
  shown.look.cuts.clear();
  shown.look.colors = {};
  const Image bare = shown.draw();
  CHECK(distance(shown.rig.color(bare, {0.1, 0, 0.13}), white) < 0.01);
}

TEST_CASE("Markers are shown as they are asked to be") {
  Shown shown(winslow::test::cube_with_cavity(6, Volumes::hexahedra));
  shown.look.colors = {};
  const auto& markers = shown.mesh.topology->markers();
  REQUIRE(markers.size() == 2);
  const std::size_t outer = markers[0].name == "outer" ? 0 : 1;
  const Vec3 side(0.1, 0, 0.1), cavity(0.45, 1.0 / 3, 0.45);
  const auto shows = [&](MarkerShow of_outer, MarkerShow of_cavity) {
    shown.look.markers.assign(2, of_cavity);
    shown.look.markers[outer] = of_outer;
    const Image image = shown.draw();
    return std::pair(shown.rig.color(image, side)[0] < 0.99,
                     shown.rig.color(image, cavity)[0] < 0.99);
  };
  using enum MarkerShow;
  CHECK(shows(automatic, automatic) == std::pair(false, true));
  CHECK(shows(automatic, hidden) == std::pair(false, false));
  CHECK(shows(surface, hidden) == std::pair(true, true));
  CHECK(markers_in_color(shown.mesh, shown.boundary, shown.look)[outer] == 1);
  CHECK(markers_in_color(shown.mesh, shown.boundary, shown.look)[1 - outer] == 0);
  CHECK(shows(hidden, automatic) == std::pair(false, true));
  // The cavity is darker than what one sees it through.
  shown.look.markers.assign(2, automatic);
  shown.look.markers[outer] = see_through;
  const Image image = shown.draw();
  CHECK(shown.rig.color(image, cavity)[0] < shown.rig.color(image, side)[0] - 0.1);
  CHECK(shown.rig.color(image, side)[0] < 0.95);
}

TEST_CASE("Isolated elements stand alone, whole, in their colours") {
  Shown shown(winslow::test::cube(4, Volumes::hexahedra));
  std::vector<unsigned char> isolated(64, 0);
  const Vec3 place(0.375, 0.125, 0.625);
  for (Index e = 0; e < 64; ++e) {
    Vec3 middle = Vec3::Zero();
    for (const Index node : shown.mesh.topology->element(e))
      middle += shown.mesh.coordinates.xyz(node) / 8;
    if ((middle - place).norm() < 1e-9) isolated[at(e)] = 1;
  }
  shown.look.isolated = isolated;
  const Image image = shown.draw();
  CHECK(distance(shown.rig.color(image, place), white) > 0.1);
  CHECK(distance(shown.rig.color(image, {0.375, 0, 0.375}), white) < 0.01);
}

TEST_CASE("Inverted elements are red wherever they are, faintly where they are hidden") {
  Shown shown(winslow::test::cube(4, Volumes::hexahedra));
  std::vector<unsigned char> inverted(64, 0);
  std::vector<std::uint32_t> grey(64, pack_color({0.5f, 0.5f, 0.5f}));
  shown.look.colors = grey;
  // Elements come row after row along x, then y: one inside, and one at the front.
  inverted[0] = inverted[16 + 4 + 1] = 1;
  shown.look.inverted = inverted;
  const Image image = shown.draw();
  const auto redness = [&](const Vec3& p) {
    const auto c = shown.rig.color(image, p);
    return c[0] - c[1];
  };
  CHECK(redness({0.125, 0, 0.125}) > 0.5);
  CHECK(redness({0.375, 0, 0.375}) > 0.05);
  CHECK(redness({0.375, 0, 0.375}) < 0.4);
  CHECK(redness({0.875, 0, 0.875}) == 0);
}

TEST_CASE("A mesh has no more cuts than the graphics card has planes to clip by") {
  Shown shown(winslow::test::cube(2, Volumes::hexahedra));
  shown.look.cuts.assign(most_clip_planes + 1, Plane({0.5, 0.5, 0.5}, {1, 0, 0}));
  CHECK_THROWS_AS(shown.draw(), UsageError);
}
