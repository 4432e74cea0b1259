#include <doctest/doctest.h>

#include <cmath>

#include "core/motion/rigid_motion.h"
#include "gui/support/pixels.h"
#include "gui/support/rig.h"

namespace winslow::gui::test {

namespace {

const MoveCommand& last_move(const Rig& rig) {
  const History& history = rig.document().history();
  return std::get<MoveCommand>(history.command(history.position()));
}

/// The ring mesh with its body selected.
void open_ring(Rig& rig) {
  rig.open(ring_mesh());
  rig.click("marker/flap");
}

}  // namespace

TEST_CASE("the arrows move along one axis, whatever the mouse does across it") {
  for (const int axis : {0, 1}) {
    CAPTURE(axis);
    Rig rig;
    open_ring(rig);
    const ScreenPoint from = midpoint(rig.gizmo().shafts[at(axis)], rig.gizmo().tips[at(axis)]);
    rig.drag(from, from + ScreenVector(31, -19));
    rig.release();
    REQUIRE(rig.settle());
    REQUIRE(rig.document().history().size() == 2);
    const double unit = rig.bench->view_control().camera().units_per_pixel();
    const Vec2 by = last_move(rig).bodies[0].motion.translate.head<2>();
    CHECK(by[axis] == doctest::Approx(unit * (axis == 0 ? 31 : 19)));
    CHECK(by[1 - axis] == 0);
  }
}

TEST_CASE("the centre moves freely, Shift is a tenth of the speed") {
  Rig rig;
  open_ring(rig);
  const ScreenPoint from = rig.gizmo().centre;
  const double unit = rig.bench->view_control().camera().units_per_pixel();
  rig.drag(from, from + ScreenVector(20, 0));
  rig.input.key(keys::shift, true);
  rig.move(from + ScreenVector(60, -30));
  rig.input.key(keys::shift, false);
  rig.frames();
  rig.release();
  REQUIRE(rig.settle());
  const Vec2 by = last_move(rig).bodies[0].motion.translate.head<2>();
  CHECK(by.x() == doctest::Approx(unit * (20 + 4)));
  CHECK(by.y() == doctest::Approx(unit * 3));
}

TEST_CASE("Ctrl snaps a move to the grid and a turn to 5 degrees") {
  Rig rig;
  open_ring(rig);
  rig.drag(rig.gizmo().centre, rig.gizmo().centre + ScreenVector(33, -17));
  rig.input.key(keys::control, true);
  rig.move(rig.pixel(Vec2(0, 0)) + ScreenVector(34, -17));
  rig.frames();
  rig.release();
  rig.input.key(keys::control, false);
  REQUIRE(rig.settle());
  const double step = MotionGesture::grid_step(rig.bench->view_control().view(), Vec3(0, 0, 0));
  const Vec2 by = last_move(rig).bodies[0].motion.translate.head<2>();
  for (const int axis : {0, 1}) {
    CHECK(by[axis] != 0);
    CHECK(std::abs(by[axis] / step - std::round(by[axis] / step)) < 1e-9);
  }

  const Gizmo gizmo = rig.gizmo();
  const double end = radians(45 + 33.3);
  rig.drag(*gizmo.knob,
           gizmo.centre + gizmo.ring_radius * ScreenVector(std::cos(end), -std::sin(end)));
  rig.input.key(keys::control, true);
  rig.frames(2);
  rig.release();
  rig.input.key(keys::control, false);
  REQUIRE(rig.settle());
  CHECK(last_move(rig).bodies[0].motion.rotate == 35);
}

TEST_CASE("X and Y lock a drag that is under way, and again set it free") {
  Rig rig;
  open_ring(rig);
  const ScreenPoint from = rig.gizmo().centre;
  rig.drag(from, from + ScreenVector(25, -15));
  rig.key(GLFW_KEY_X);
  CHECK(rig.session().mesh().live_motion()->translate.y() == 0);
  rig.key(GLFW_KEY_Y);
  CHECK(rig.session().mesh().live_motion()->translate.x() == 0);
  CHECK(rig.session().mesh().live_motion()->translate.y() > 0);
  rig.key(GLFW_KEY_Y);
  CHECK(rig.session().mesh().live_motion()->translate.x() > 0);
  CHECK(rig.session().mesh().live_motion()->translate.y() > 0);
  rig.release();
  CHECK(rig.settle());
}

TEST_CASE("Enter accepts a drag with the button still down; letting go does nothing more") {
  Rig rig;
  open_ring(rig);
  const ScreenPoint from = rig.gizmo().centre;
  rig.drag(from, from + ScreenVector(25, 0));
  rig.key(keys::enter);
  CHECK_FALSE(rig.session().dragging());
  rig.move(from + ScreenVector(90, 0));
  rig.release();
  REQUIRE(rig.settle());
  REQUIRE(rig.document().history().size() == 2);
  CHECK(last_move(rig).bodies[0].motion.translate.x() ==
        doctest::Approx(25 * rig.bench->view_control().camera().units_per_pixel()));
  CHECK_FALSE(rig.session().selection().empty());
}

TEST_CASE("Tab goes from body to body, Shift+Tab back, the outer boundary left out") {
  Rig rig;
  rig.open(two_body_mesh());
  const std::vector<Index> left{rig.marker("left")};
  const std::vector<Index> right{rig.marker("right")};
  rig.key(keys::tab);
  const bool left_first = rig.session().selection().markers() == left;
  CHECK(rig.session().selection().markers() == (left_first ? left : right));
  rig.key(keys::tab);
  CHECK(rig.session().selection().markers() == (left_first ? right : left));
  rig.key(keys::tab);
  CHECK(rig.session().selection().markers() == (left_first ? left : right));
  rig.key(keys::tab, {keys::shift});
  CHECK(rig.session().selection().markers() == (left_first ? right : left));
}

TEST_CASE("Shift+click adds a body to the selection") {
  Rig rig;
  rig.open(two_body_mesh());
  rig.click(rig.pixel(Vec2(-2, 0)));
  rig.input.key(keys::shift, true);
  rig.click(rig.pixel(Vec2(2, 0)));
  rig.input.key(keys::shift, false);
  CHECK(rig.session().selection().markers().size() == 2);
  // One gizmo for both, between them.
  CHECK((rig.session().selection().pivot() - Vec2(0, 0)).norm() < 1e-12);
}

TEST_CASE("the pivot goes to the edges and the centroid by name, and turns are about it") {
  Rig rig;
  open_ring(rig);
  const auto choose = [&](const char* place) {
    rig.click("motion/pivot_place");
    rig.click(std::string("motion/pivot_place/") + place);
  };
  choose("Trailing edge");
  CHECK((rig.session().selection().pivot() - Vec2(0.5, 0)).norm() < 1e-9);
  choose("Leading edge");
  CHECK((rig.session().selection().pivot() - Vec2(-0.5, 0)).norm() < 1e-9);
  const Index nose = [&] {
    for (Index node : rig.mesh().topology->markers().nodes(rig.marker("flap")))
      if ((rig.mesh().coordinates.xy(node) - Vec2(-0.5, 0)).norm() < 1e-9) return node;
    return Index(-1);
  }();
  REQUIRE(nose >= 0);
  rig.fill("motion/rotate", "15");
  rig.click("motion/apply");
  REQUIRE(rig.settle());
  CHECK((rig.mesh().coordinates.xy(nose) - Vec2(-0.5, 0)).norm() < 1e-9);
  choose("Centroid");
  const Vec2 expected = transform(last_move(rig).bodies[0].motion, Vec2(0, 0));
  CHECK((rig.session().selection().pivot() - expected).norm() < 1e-9);
}

TEST_CASE("with Alt the disc in the middle takes the pivot elsewhere and leaves the body") {
  Rig rig;
  open_ring(rig);
  const Coordinates before = rig.session().coordinates();
  const ScreenPoint disc = rig.gizmo().centre;
  rig.input.key(keys::alt, true);
  rig.drag(disc, disc + ScreenVector(20, -12));
  rig.release();
  rig.input.key(keys::alt, false);
  REQUIRE(rig.settle());
  CHECK((rig.pixel(rig.session().selection().pivot()) - disc - ScreenVector(20, -12)).norm() < 1.5);
  CHECK(rig.session().coordinates() == before);
  CHECK_FALSE(rig.session().nodes().inspected().has_value());
}

TEST_CASE("with Ctrl the pivot's pin snaps to the trailing edge and to nodes; Esc puts it back") {
  Rig rig;
  open_ring(rig);
  const Mesh& mesh = rig.mesh();
  rig.drag(*rig.gizmo().pin, rig.pixel(Vec2(0.5, 0)) + ScreenVector(5, 4));
  rig.input.key(keys::control, true);
  rig.frames();
  CHECK((rig.session().selection().pivot() - Vec2(0.5, 0)).norm() < 1e-9);
  CHECK(rig.bench->pane().viewport().snapped_to() == "trailing edge");
  const auto nodes = mesh.topology->markers().nodes(rig.marker("flap"));
  const Vec2 node = mesh.coordinates.xy(nodes[3]);
  rig.move(rig.pixel(node) + ScreenVector(1, 1));
  rig.frames();
  CHECK((rig.session().selection().pivot() - node).norm() < 1e-12);
  rig.input.key(keys::control, false);
  rig.key(keys::escape);
  CHECK(rig.session().selection().pivot().norm() < 1e-12);
  rig.release();
  CHECK(rig.document().history().size() == 1);
}

TEST_CASE("hovering a handle says what it does") {
  Rig rig;
  open_ring(rig);
  rig.move(ScreenPoint(2, 700));
  rig.frames();
  const Image before = rig.bench->pictures().picture();
  const ScreenPoint at = rig.gizmo().tips[0];
  rig.move(at);
  rig.frames();
  CHECK(rig.mover().handle() == Handle{Handle::Kind::arrow, 0});
  const Image hinted = rig.bench->pictures().picture();
  // The hint stands to the right of the mouse, below it.
  CHECK(differing(before, hinted, at + ScreenVector(20, 16), at + ScreenVector(100, 36)) > 300);
}

TEST_CASE("the numbers of a drag stay in sight: over the legend, and where the view ends") {
  Rig rig;
  open_ring(rig);
  const auto legend = rig.bench->widgets().find("legend");
  REQUIRE(legend.has_value());
  const Area& v = rig.bench->layout().viewport;
  const ScreenPoint at(v.x + v.width - 8, legend->min.y() + 50);
  rig.drag(rig.gizmo().centre, at);
  rig.frames();
  const Image image = rig.bench->pictures().picture();
  int dark = 0;
  for (int x = 14; x < 120; ++x)
    for (int y = 14; y < 32; ++y)
      dark += brightness(image, at + ScreenVector(-x, y)) < 0.35 ? 1 : 0;
  CHECK(dark > 1000);
  rig.key(keys::escape);
  rig.release();
}

TEST_CASE("the status line and the handle say when no valid mesh lies beyond") {
  Rig rig;
  open_ring(rig);
  const ScreenPoint from = rig.gizmo().centre;
  rig.drag(from, from + ScreenVector(20, 0));
  REQUIRE(rig.wait([&] { return rig.session().mesh().work().body_drag()->settled(); }));
  rig.frames();
  const Image free = rig.bench->pictures().picture();
  const ScreenPoint far = from + ScreenVector(450, 0);
  rig.move(far);
  REQUIRE(rig.wait(
      [&] { return rig.session().mesh().work().body_drag()->reach() == BodyDrag::Reach::limit; }));
  rig.frames();
  const Image held = rig.bench->pictures().picture();
  const auto state = rig.bench->widgets().find("status/state");
  REQUIRE(state.has_value());
  CHECK(differing(free, held, state->min, state->max) > 50);
  CHECK(rig.session().mesh().work().body_drag()->frame().min_sine > 0);
  rig.key(keys::escape);
  rig.release();
  CHECK(rig.settle());
}

}  // namespace winslow::gui::test
