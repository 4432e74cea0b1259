#include <doctest/doctest.h>

#include <cmath>

#include "core/inspect/node_roles.h"
#include "gui/support/keys.h"
#include "gui/support/pixels.h"
#include "gui/support/rig.h"
#include "gui/view/overlays/role_overlay.h"
#include "support/meshes.h"
#include "support/space_meshes.h"

namespace winslow::gui::test {

namespace {

const SlideOptions& slide_of(const Rig& rig) { return rig.session().jobs().smooth_options().slide; }

/// A square whose sides left and right have their nodes too near to its ends, alike.
Mesh plane_square() {
  MeshData data = winslow::test::square(8, winslow::test::Cells::triangles);
  for (Index i = 0; i < data.node_count(); ++i) {
    const Vec2 p = data.coordinates.xy(i);
    if (p.x() == 0 || p.x() == 1)
      data.coordinates.set_xy(i, {p.x(), p.y() - 0.03 * std::sin(4 * pi * p.y())});
  }
  return make_mesh(data);
}

/// By a right click on the marker's role and the list that it leads to.
void pair(Rig& rig, const std::string& first, const std::string& second) {
  const auto word = rig.bench->widgets().find("marker_role/" + first);
  REQUIRE(word.has_value());
  rig.move(word->centre());
  rig.press(MouseButton::right);
  rig.release(MouseButton::right);
  rig.frames(3);
  rig.click("menu/body/periodic");
  rig.frames(3);
  CHECK_FALSE(rig.visible("menu/periodic/" + first));
  rig.click("menu/periodic/" + second);
  rig.frames(3);
}

bool in_key(const Rig& rig, NodeRole role) {
  return rig.visible("roles/key/" + std::to_string(static_cast<int>(role)));
}

/// Pixels of a colour within a few of a place.
int coloured(const Image& image, const ScreenPoint& at, ImU32 color) {
  const ImVec4 wanted = ImGui::ColorConvertU32ToFloat4(color);
  int count = 0;
  for (int dy = -2; dy <= 2; ++dy)
    for (int dx = -2; dx <= 2; ++dx) {
      const auto* p = image.pixel(static_cast<int>(at.x()) + dx, static_cast<int>(at.y()) + dy);
      count += std::abs(p[0] - 255 * wanted.x) < 12 && std::abs(p[1] - 255 * wanted.y) < 12 &&
               std::abs(p[2] - 255 * wanted.z) < 12;
    }
  return count;
}

}  // namespace

TEST_CASE(
    "two markers are made periodic by clicks, the next run keeps them so, and they are parted") {
  Rig rig(1280, 900);
  rig.open(plane_square());
  rig.click("marker_role/left");
  REQUIRE(slide_of(rig).markers == std::vector<std::string>{"left"});
  pair(rig, "left", "right");
  CHECK(slide_of(rig).periodic == std::vector<std::string>{"left", "right"});
  CHECK(slide_of(rig).markers.empty());  // it no longer slides
  rig.bench->apply(action::RunSmooth{});
  REQUIRE(rig.settle());
  const auto& done = std::get<SmoothCommand>(
      rig.document().history().command(rig.document().history().position()));
  CHECK(done.smooth.slide.periodic.size() == 2);
  int moved = 0;
  const PeriodicPairs pairs =
      PeriodicPairs::find(*rig.mesh().topology, rig.mesh().coordinates, "left", "right");
  const Coordinates& given = rig.document().history().state(0).mesh.coordinates;
  for (const auto& [node, image] : pairs.pairs) {
    const Vec2 p = rig.mesh().coordinates.xy(node), q = rig.mesh().coordinates.xy(image);
    CHECK((q - p - Vec2(1, 0)).norm() < 1e-12);
    moved += (p - given.xy(node)).norm() > 1e-9;
  }
  CHECK(moved > 0);
  // A click on the word of a periodic side opens the list again: none.
  rig.click("marker_role/right");
  rig.frames(3);
  rig.click("menu/body/periodic");
  rig.frames(3);
  rig.click("menu/periodic/none");
  rig.frames(2);
  CHECK(slide_of(rig).periodic.empty());
}

TEST_CASE("sides that do not match are refused, and which pair does not is said") {
  Rig rig(1280, 900);
  rig.open(ring_mesh());
  pair(rig, "flap", "farfield");
  CHECK(slide_of(rig).periodic.empty());
  REQUIRE(rig.session().messages().prompt() != nullptr);
  CHECK(rig.session().messages().prompt()->text.find("flap") != std::string::npos);
}

TEST_CASE("what nodes do is shown in colours with a key, and follows roles and feature angle") {
  Rig rig(1280, 900);
  rig.open(plane_square());
  CHECK_FALSE(rig.visible("markers/feature_angle"));
  rig.click("marker_role/top");
  REQUIRE(rig.settle());
  rig.frames(2);
  CHECK_FALSE(rig.visible("roles/key"));
  rig.click("markers/roles");
  REQUIRE(rig.settle());
  rig.frames(2);
  CHECK(rig.bench->view_control().options().roles);
  REQUIRE(rig.visible("roles/key"));
  CHECK(in_key(rig, NodeRole::on_curve));
  CHECK(in_key(rig, NodeRole::corner));
  CHECK_FALSE(in_key(rig, NodeRole::periodic));
  rig.move(ScreenPoint(5, 5));
  rig.frames(2);
  const Image picture = rig.bench->pictures().picture();
  CHECK(coloured(picture, rig.pixel(Vec2(0.5, 1)), color_of(NodeRole::on_curve)) > 8);
  CHECK(coloured(picture, rig.pixel(Vec2(1, 1)), color_of(NodeRole::corner)) > 8);
  CHECK(coloured(picture, rig.pixel(Vec2(0.5, 0)), color_of(NodeRole::on_curve)) == 0);
  pair(rig, "left", "right");
  REQUIRE(rig.settle());
  rig.frames(2);
  CHECK(in_key(rig, NodeRole::periodic));
  rig.click("markers/roles");
  rig.frames(2);
  CHECK_FALSE(rig.visible("roles/key"));
  // While the angle is edited it is shown, and no longer.
  rig.click("markers/feature_angle");
  REQUIRE(rig.settle());
  rig.frames(3);
  CHECK(rig.visible("roles/key"));
  rig.key(keys::a, {keys::control});
  rig.type("75");
  rig.key(keys::enter);
  REQUIRE(rig.settle());
  rig.frames(3);
  CHECK(slide_of(rig).feature_angle == 75);
  CHECK_FALSE(rig.visible("roles/key"));
}

TEST_CASE("roles in space: seen nodes of a sliding face have dots, and along its edges if asked") {
  Rig rig(1280, 900);
  rig.open(make_mesh(winslow::test::cube(4, winslow::test::Volumes::tetrahedra)));
  rig.key(GLFW_KEY_5);  // from above, onto the lid
  rig.click("marker_role/lid");
  rig.frames(2);
  rig.click("markers/roles");
  REQUIRE(rig.settle());
  rig.move(ScreenPoint(5, 5));
  rig.frames(3);
  REQUIRE(rig.visible("roles/key"));
  CHECK(in_key(rig, NodeRole::on_surface));
  CHECK(rig.visible("markers/features"));
  const View& view = rig.bench->view_control().view();
  const auto dots = [&](const Vec3& place, NodeRole role) {
    const Image picture = rig.bench->pictures().picture();
    return coloured(picture, view.project(place).at, color_of(role));
  };
  CHECK(dots({0.5, 0.5, 1}, NodeRole::on_surface) > 8);
  CHECK(dots({0, 0.5, 1}, NodeRole::corner) > 8);
  rig.key(GLFW_KEY_6);  // from below the lid is hidden
  REQUIRE(rig.settle());
  rig.frames(2);
  CHECK(dots({0.5, 0.5, 1}, NodeRole::on_surface) == 0);
  // With the edges, too: nodes at the lid's border slide along it where the walls slide as well.
  rig.click("marker_role/walls");
  rig.click("markers/features");
  REQUIRE(rig.settle());
  rig.frames(2);
  CHECK(slide_of(rig).features);
  CHECK(in_key(rig, NodeRole::on_curve));
}

TEST_CASE("spacing is held by the form, and what then stays is shown to") {
  Rig rig(1280, 900);
  rig.open(plane_square());
  CHECK_FALSE(rig.visible("markers/spacing"));
  rig.click("marker_role/top");
  rig.frames(2);
  rig.click("markers/roles");
  REQUIRE(rig.settle());
  rig.frames(2);
  REQUIRE(rig.visible("markers/spacing"));
  CHECK(slide_of(rig).spacing == SlideSpacing::automatic);
  CHECK(in_key(rig, NodeRole::on_curve));
  rig.click("markers/spacing");
  rig.click("markers/spacing/Held");
  REQUIRE(rig.settle());
  rig.frames(3);
  CHECK(slide_of(rig).spacing == SlideSpacing::held);
  CHECK_FALSE(in_key(rig, NodeRole::on_curve));
  CHECK(in_key(rig, NodeRole::corner));
  // In space it is of edges, and there where nodes slide along these.
  Rig space(1280, 900);
  space.open(make_mesh(winslow::test::cube(4, winslow::test::Volumes::tetrahedra)));
  space.click("marker_role/lid");
  space.frames(2);
  CHECK_FALSE(space.visible("markers/spacing"));
  space.click("markers/features");
  space.frames(2);
  CHECK(space.visible("markers/spacing"));
}

}  // namespace winslow::gui::test
