#include "gui/view/tools/motion_gesture.h"

#include <doctest/doctest.h>

#include <cmath>

#include "core/motion/rigid_motion.h"

namespace winslow::gui {

namespace {

Camera plane() {
  Camera c;
  c.set_viewport(0, 0, 800, 600);
  c.look_at(Vec2(0, 0), 0.01);
  return c;
}

/// A drag of a handle of the plane's gizmo, whose pivot is the origin.
MotionGesture begun(const Handle& handle, const ScreenPoint& from, const View& view) {
  MotionGesture drag;
  drag.begin(handle, from, make_gizmo(view, {.in_plane = true}, 1).value(), view);
  return drag;
}

}  // namespace

TEST_CASE("the grid is a round number of units, 8 to 20 pixels wide, at any zoom") {
  Camera c = plane();
  for (double zoom = 1e-6; zoom < 1e6; zoom *= 1.7) {
    c.look_at(Vec2(0, 0), zoom);
    const double step = MotionGesture::grid_step(c, Vec3(0, 0, 0));
    CHECK(step >= 8 * zoom);
    CHECK(step <= 20 * zoom * (1 + 1e-12));
    const double digit = step / std::pow(10, std::floor(std::log10(step * (1 + 1e-12))));
    CAPTURE(digit);
    CHECK((std::abs(digit - 1) < 1e-9 || std::abs(digit - 2) < 1e-9 || std::abs(digit - 5) < 1e-9));
  }
}

TEST_CASE("fine motion adds up with coarse, and does not jump when Shift goes") {
  const Camera c = plane();
  MotionGesture drag = begun({Handle::Kind::centre, 0}, ScreenPoint(100, 100), c);
  CHECK(drag.drag_to(ScreenPoint(200, 100), {}, c));
  CHECK(drag.translate().x() == doctest::Approx(1));
  CHECK(drag.drag_to(ScreenPoint(300, 100), {true, false}, c));
  CHECK(drag.translate().x() == doctest::Approx(1.1));
  CHECK_FALSE(drag.drag_to(ScreenPoint(300, 100), {}, c));
  CHECK(drag.drag_to(ScreenPoint(310, 100), {}, c));
  CHECK(drag.translate().x() == doctest::Approx(1.2));
}

TEST_CASE("a lock keeps the other axis at nothing and forgets nothing") {
  const Camera c = plane();
  MotionGesture drag = begun({Handle::Kind::arrow, 1}, ScreenPoint(100, 100), c);
  drag.drag_to(ScreenPoint(150, 70), {}, c);
  CHECK(drag.translate() == Vec3(0, drag.translate().y(), 0));
  CHECK(drag.translate().y() == doctest::Approx(0.3));
  drag.toggle_axis(1, c);
  drag.drag_to(ScreenPoint(150, 70), {}, c);
  CHECK(drag.translate().x() == doctest::Approx(0.5));
  drag.toggle_axis(0, c);
  drag.drag_to(ScreenPoint(150, 70), {}, c);
  CHECK(drag.translate().y() == 0);
}

TEST_CASE("turns are counted past half a turn and snapped in total") {
  const Camera c = plane();
  const auto at = [&](double degrees) -> ScreenPoint {
    const double t = radians(degrees);
    return c.to_screen(Vec2(std::cos(t), std::sin(t)));
  };
  MotionGesture drag = begun({Handle::Kind::ring, 2}, at(0), c);
  for (int k = 1; k <= 53; ++k) drag.drag_to(at(10.0 * k), {}, c);
  CHECK(drag.rotate() == doctest::Approx(530));
  drag.drag_to(at(532), {false, true}, c);
  CHECK(drag.rotate() == 530);
  CHECK(drag.motion() == RigidMotion{530, Vec2(0, 0), Vec2(0, 0)});
}

TEST_CASE(
    "a mouse that comes back to where it was pressed, by whatever way, moves nothing at all") {
  Camera c;
  c.set_viewport(0, 0, 800, 600);
  for (const Vec2& far : {Vec2(0.3, 0.7), Vec2(4.5e5, 5.1e6)}) {
    c.look_at(far, 0.0137);
    const ScreenPoint press(491.3, 277.7);  // right of the pivot, which is in the middle
    for (const Handle& handle : {Handle{Handle::Kind::centre, 0}, Handle{Handle::Kind::arrow, 1},
                                 Handle{Handle::Kind::ring, 2}}) {
      const Gizmo gizmo =
          make_gizmo(c, {.pivot = Vec3(far.x(), far.y(), 0), .in_plane = true}, 1).value();
      MotionGesture drag;
      drag.begin(handle, press, gizmo, c);
      const RigidMotion rest = drag.motion();
      CHECK_FALSE(moves(rest));
      // Up and to the left, and down again by another way: around the pivot there and back.
      for (int k = 1; k <= 77; ++k) drag.drag_to(press + ScreenVector(-2.1 * k, -1.3 * k), {}, c);
      CHECK(moves(drag.motion()));
      for (int k = 76; k >= 1; --k)
        drag.drag_to(press + ScreenVector(-2.1 * k + 7.7, -1.3 * k), {}, c);
      drag.drag_to(press, {}, c);
      CHECK(drag.motion() == rest);
      // A hundredth of a pixel counts.
      drag.drag_to(press + ScreenVector(0.003, -0.01), {}, c);
      CHECK(moves(drag.motion()));
    }
  }
}

TEST_CASE("a view that is zoomed during a drag leaves the motion as it is") {
  Camera c = plane();
  MotionGesture drag = begun({Handle::Kind::centre, 0}, ScreenPoint(100, 100), c);
  drag.drag_to(ScreenPoint(150, 80), {}, c);
  const Vec3 before = drag.translate();
  c.zoom_about(c.at_depth_of(Vec3(0, 0, 0), ScreenPoint(150, 80)), 3);
  drag.drag_to(ScreenPoint(150, 80), {}, c);
  CHECK((drag.translate() - before).norm() < 1e-12);
  drag.drag_to(ScreenPoint(180, 80), {}, c);
  CHECK(drag.translate().x() == doctest::Approx(before.x() + 0.1));
}

TEST_CASE("in the plane Z keeps to nothing, and a turn has no other axis") {
  const Camera c = plane();
  MotionGesture drag = begun({Handle::Kind::centre, 0}, ScreenPoint(100, 100), c);
  drag.toggle_axis(2, c);
  CHECK(drag.directions().size() == 2);
  drag.drag_to(ScreenPoint(150, 70), {}, c);
  CHECK(drag.translate().x() == doctest::Approx(0.5));
  MotionGesture turn = begun({Handle::Kind::ring, 2}, ScreenPoint(480, 300), c);
  turn.toggle_axis(0, c);
  CHECK(turn.axis() == Vec3(0, 0, 1));
}

}  // namespace winslow::gui
