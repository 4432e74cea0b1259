#include "gui/view/tools/ruler.h"

#include <doctest/doctest.h>

#include "gui/support/rig.h"
#include "gui/view/overlays/tool_overlay.h"

namespace winslow::gui::test {

namespace {

using Points = std::vector<RulerPoint>;

RulerPoint at(double x, double y) { return {Vec3(x, y, 0), {}, {}}; }

}  // namespace

TEST_CASE("a measurement is the length, the vector and the angle against x, then at the corner") {
  CHECK_FALSE(measure(Points{at(0, 0)}).has_value());
  const auto two = measure(Points{at(1, 1), at(4, 5)});
  REQUIRE(two.has_value());
  CHECK(two->length == doctest::Approx(5));
  CHECK(two->along == Vec3(3, 4, 0));
  CHECK(*two->direction == doctest::Approx(53.130102));
  CHECK_FALSE(two->angle.has_value());
  const auto three = measure(Points{at(1, 0), at(0, 0), at(0, 2)});
  REQUIRE(three->angle.has_value());
  CHECK(*three->angle == doctest::Approx(90));
  CHECK(*three->second == doctest::Approx(2));
  const auto nowhere = measure(Points{at(1, 0), at(1, 0), at(0, 2)});
  CHECK_FALSE(nowhere->angle.has_value());
}

TEST_CASE("rounding errors of nodes are no distance") {
  const auto lines = measurement_lines(*measure(Points{at(0, 0), at(1, -3.3e-17)}));
  REQUIRE(lines.size() == 3);
  CHECK(lines[1] == "x +1   y +0");
  CHECK(lines[2].starts_with("0.00"));
}

TEST_CASE("the ruler measures by clicks that snap to nodes, selects nothing, and ends with Esc") {
  Rig rig;
  rig.open(two_body_mesh());
  rig.key(keys::r);
  REQUIRE(rig.bench->view_control().state().ruler);
  CHECK(rig.visible("mode"));
  // Within reach of the nodes (-1.5, 0.5), (-1.5, -0.5) and (-2.5, -0.5), corners of a hole.
  const ScreenVector beside(3, 2);
  rig.click(rig.pixel(Vec2(-1.5, 0.5)) + beside);
  rig.click(rig.pixel(Vec2(-1.5, -0.5)) + beside);
  const auto& points = rig.bench->pane().ruler().points();
  REQUIRE(points.size() == 2);
  CHECK(points[0].node.has_value());
  CHECK(measure(points)->length == doctest::Approx(1));
  CHECK(*measure(points)->direction == doctest::Approx(-90));
  CHECK(rig.visible("ruler"));
  rig.click(rig.pixel(Vec2(-2.5, -0.5)) + beside);
  REQUIRE(points.size() == 3);
  CHECK(*measure(points)->angle == doctest::Approx(90));
  CHECK(rig.session().selection().empty());
  // The view is still panned by a drag; the points stay where they are in the mesh.
  rig.drag(rig.pixel(Vec2(0, 1.6)), rig.pixel(Vec2(0, 1.6)) + ScreenVector(60, 10));
  rig.release();
  CHECK(points.size() == 3);
  CHECK(points[2].at == Vec3(-2.5, -0.5, 0));
  rig.key(keys::escape);
  CHECK_FALSE(rig.bench->view_control().state().ruler);
  CHECK(rig.bench->pane().ruler().points().empty());
  CHECK_FALSE(rig.visible("ruler"));
}

TEST_CASE("with Shift the ruler takes the point itself; its nodes go with the mesh") {
  Rig rig;
  rig.open(two_body_mesh());
  rig.key(keys::r);
  const ScreenPoint free = rig.pixel(Vec2(0, 1)) + ScreenVector(3, 2);
  rig.input.key(keys::shift, true);
  rig.click(free);
  rig.input.key(keys::shift, false);
  const auto& points = rig.bench->pane().ruler().points();
  REQUIRE(points.size() == 1);
  CHECK_FALSE(points[0].node.has_value());
  CHECK((points[0].at - Vec3(0, 1, 0)).norm() > 0);
  rig.click(rig.pixel(Vec2(-1.5, 0.5)));
  REQUIRE(points.size() == 2);
  rig.bench->apply(action::SelectMarkers{{rig.marker("left")}});
  rig.bench->apply(action::ApplyMotion{{0, Vec2(0, 0), Vec2(0.25, 0)}});
  REQUIRE(rig.settle());
  CHECK((points[1].at - Vec3(-1.25, 0.5, 0)).norm() < 1e-9);
}

}  // namespace winslow::gui::test
