#include "gui/view/overlays/foot_overlay.h"

#include <doctest/doctest.h>

#include <cmath>

#include "gui/support/rig.h"

namespace winslow::gui::test {

namespace {

bool seen(const Mesh& mesh, const Vec2& at, double half) {
  const Vec2 room(half, half);
  return anything_in_view(*mesh.topology, mesh.coordinates, {at - room, at + room});
}

}  // namespace

TEST_CASE("a box shows some of a mesh if its boundary runs through it, or it lies inside") {
  const Mesh mesh = two_body_mesh();
  CHECK(seen(mesh, Vec2(0, 0), 0.01));       // inside an element, no node in sight
  CHECK(seen(mesh, Vec2(0, 0), 100));        // all of it
  CHECK_FALSE(seen(mesh, Vec2(2, 0), 0.1));  // in a hole
  CHECK(seen(mesh, Vec2(2, 0), 0.6));        // the hole's rim
  CHECK_FALSE(seen(mesh, Vec2(9, 0), 0.5));  // beside
  CHECK(seen(mesh, Vec2(4.4, 0), 0.5));      // the rim
}

TEST_CASE("where nothing is in view the studio says so, and Home fits all") {
  Rig rig;
  rig.open(two_body_mesh());
  CHECK_FALSE(rig.visible("out_of_view"));
  rig.bench->apply(action::LookAt{Vec3(50, 50, 0), 1});
  rig.frames();
  CHECK(rig.visible("out_of_view"));
  rig.key(GLFW_KEY_HOME);
  CHECK_FALSE(rig.visible("out_of_view"));
  CHECK((rig.bench->view_control().camera().centre() - Vec2(0, 0)).norm() < 1e-9);
  // In a hole there is nothing either.
  rig.bench->apply(action::LookAt{Vec3(2, 0, 0), 0.1});
  rig.frames();
  CHECK(rig.visible("out_of_view"));
}

TEST_CASE("Fit bodies shows the holes alone; a double click on a marker looks at it") {
  Rig rig;
  rig.open(ring_mesh());
  const auto width = [&] { return rig.bench->view_control().camera().visible().size().x(); };
  const double whole = width();
  rig.key(GLFW_KEY_B);
  CHECK(width() < 0.5 * whole);
  CHECK(width() >= 1);
  const auto row = rig.bench->widgets().find("marker/farfield");
  REQUIRE(row.has_value());
  rig.click(row->centre());
  rig.click(row->centre());
  CHECK(width() > 6);
  // In the picture, on the body.
  rig.key(GLFW_KEY_HOME);
  for (int i = 0; i < 30; ++i) rig.frames(1);  // not a third click
  const ScreenPoint body = rig.pixel(Vec2(0.3, 0));
  rig.click(body);
  rig.bench->apply(action::SelectMarkers{});
  rig.click(body);
  CHECK(width() < 0.5 * whole);
}

TEST_CASE("the status bar says where the mouse is, as finely as a pixel is") {
  Rig rig;
  rig.open(two_body_mesh());
  rig.move(rig.pixel(Vec2(1.25, -0.75)));
  rig.frames();
  const auto& cursor = rig.bench->view_control().state().cursor;
  REQUIRE(cursor.has_value());
  CHECK((*cursor - Vec2(1.25, -0.75)).norm() < rig.bench->view_control().state().pixel);
  REQUIRE(rig.visible("status/cursor"));
  // Panels are no part of the mesh.
  rig.move(rig.bench->widgets().find("solver/run")->centre());
  rig.frames();
  CHECK_FALSE(rig.bench->view_control().state().cursor.has_value());
  CHECK_FALSE(rig.visible("status/cursor"));
}

TEST_CASE("the scale bar is a round length of the mesh, and can be hidden") {
  CHECK(round_length(7.2) == 5);
  CHECK(round_length(4.9) == 2);
  CHECK(round_length(0.0199) == doctest::Approx(0.01));
  CHECK(round_length(2000) == 2000);
  Rig rig;
  rig.open(two_body_mesh());
  const auto length = [&] {
    const auto bar = rig.bench->widgets().find("scale_bar");
    REQUIRE(bar.has_value());
    return (bar->max.x() - bar->min.x()) * rig.bench->view_control().camera().units_per_pixel();
  };
  const double before = length();
  CHECK(before == doctest::Approx(round_length(before * 1.001)).epsilon(1e-3));
  rig.wheel(rig.pixel(Vec2(0, 0)), 12);
  rig.frames();
  CHECK(length() < 0.5 * before);
  rig.bench->apply(action::EditView{[&] {
    ViewOptions after = rig.bench->view_control().options();
    after.scale_bar = false;
    return difference(rig.bench->view_control().options(), after);
  }()});
  rig.frames();
  CHECK_FALSE(rig.visible("scale_bar"));
}

}  // namespace winslow::gui::test
