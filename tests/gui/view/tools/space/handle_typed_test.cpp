#include <doctest/doctest.h>

#include <array>

#include "gui/support/moving_rig.h"

namespace winslow::gui::test {

TEST_CASE("Esc takes a drag back to the bit, Enter ends it with the button down") {
  MovingStudio studio;
  const Coordinates before = studio.mesh().coordinates;
  const ScreenPoint from = studio.handle("arrow/z");
  studio.drag(from, from + ScreenVector(0, -30));
  studio.follow();
  REQUIRE(studio.session().coordinates() != before);
  studio.key(keys::escape);
  CHECK_FALSE(studio.session().dragging());
  studio.release();
  REQUIRE(studio.settle());
  CHECK(studio.session().coordinates() == before);
  CHECK(studio.document().history().size() == 1);
  CHECK_FALSE(studio.session().selection().empty());
  studio.drag(studio.handle("arrow/z"), from + ScreenVector(0, -30));
  const Vec3 way = studio.live().translate;
  studio.key(keys::enter);
  CHECK_FALSE(studio.session().dragging());
  studio.move(from + ScreenVector(0, -90));
  studio.release();
  REQUIRE(studio.settle());
  REQUIRE(studio.document().history().size() == 2);
  CHECK(studio.last_motion().translate == way);
}

TEST_CASE("Numbers typed in a drag count in place of the mouse: 30 Enter, x Tab y Tab z") {
  MovingStudio studio;
  const ViewDirection looked = studio.view().camera().direction();
  const ScreenPoint ring = studio.handle("ring/y");
  studio.drag(ring, ring + ScreenVector(6, 6));
  studio.key(GLFW_KEY_3);  // as a keyboard does: the key, and its character
  studio.type("3");
  studio.key(GLFW_KEY_0);
  studio.type("0");
  CHECK(studio.live().rotate == 30);
  CHECK(studio.live().axis == Vec3(0, 1, 0));
  CHECK(studio.view().camera().direction() == looked);  // 3 looks from +y otherwise
  studio.key(keys::enter);
  studio.release();
  REQUIRE(studio.settle());
  CHECK(studio.last_motion().rotate == 30);

  const ScreenPoint centre = studio.handle("centre");
  studio.drag(centre, centre + ScreenVector(10, 0));
  studio.type("0.02");
  studio.key(keys::tab);
  studio.type("-0.01");
  studio.key(keys::tab);
  studio.type("0.035");
  studio.key(GLFW_KEY_BACKSPACE);
  CHECK(studio.live().translate == Vec3(0.02, -0.01, 0.03));
  studio.key(keys::enter);
  studio.release();
  REQUIRE(studio.settle());
  CHECK(studio.last_motion().translate == Vec3(0.02, -0.01, 0.03));
}

TEST_CASE("Without numbers the mouse counts again") {
  MovingStudio studio;
  const ScreenPoint from = studio.handle("arrow/z");
  studio.drag(from, from + ScreenVector(0, -20));
  const Vec3 by_mouse = studio.live().translate;
  studio.type("0.1");
  CHECK(studio.live().translate == Vec3(0, 0, 0.1));
  for (int k = 0; k < 3; ++k) studio.key(GLFW_KEY_BACKSPACE);
  studio.frames();
  CHECK((studio.live().translate - by_mouse).norm() < 1e-12);
  studio.key(keys::escape);
  studio.release();
  CHECK(studio.settle());
}

TEST_CASE("Ctrl snaps to round lengths and 5 degrees, Shift goes at a tenth of the speed") {
  MovingStudio studio;
  const ScreenPoint from = studio.handle("centre");
  studio.drag(from, from + ScreenVector(23, -14));
  studio.input.key(keys::control, true);
  studio.frames();
  const double step = MotionGesture::grid_step(studio.view(), Vec3(0.5, 0.5, 0.5));
  const Vec3 snapped = studio.live().translate;
  CHECK(snapped.norm() > 0);
  for (Index k = 0; k < 3; ++k)
    CHECK(std::abs(snapped[k] / step - std::round(snapped[k] / step)) < 1e-9);
  studio.input.key(keys::control, false);
  studio.key(keys::escape);
  studio.release();
  REQUIRE(studio.settle());

  const ScreenPoint ring = studio.handle("screen_ring"), centre = studio.space_gizmo().centre;
  studio.drag(ring, ring);
  studio.input.key(keys::control, true);
  go_around(studio, centre, ring, 33.3, 8);
  CHECK(studio.live().rotate == 35);
  studio.input.key(keys::control, false);
  studio.key(keys::escape);
  studio.release();
  REQUIRE(studio.settle());

  studio.drag(from, from);
  studio.input.key(keys::shift, true);
  studio.move(from + ScreenVector(40, 0));
  CHECK(pixels(studio, studio.live().translate) == doctest::Approx(4));
  studio.input.key(keys::shift, false);
  studio.move(from + ScreenVector(50, 0));
  CHECK(pixels(studio, studio.live().translate) == doctest::Approx(14));
  studio.key(keys::escape);
  studio.release();
  CHECK(studio.settle());
}

TEST_CASE(
    "X, Y and Z keep a drag to that axis, again and it is free; of a ring they are the axis") {
  MovingStudio studio;
  const bool zoom_armed = studio.bench->view_control().state().box_zoom_armed;
  const ScreenPoint from = studio.handle("centre");
  studio.drag(from, from + ScreenVector(25, -18));
  const Vec3 free = studio.live().translate;
  const std::array<int, 3> letters{GLFW_KEY_X, GLFW_KEY_Y, GLFW_KEY_Z};
  for (int k = 0; k < 3; ++k) {
    studio.key(letters[at(k)]);
    const Vec3 way = studio.live().translate;
    CHECK(way[k] != 0);
    CHECK(way.cwiseAbs().sum() == std::abs(way[k]));
  }
  CHECK(studio.bench->view_control().state().box_zoom_armed == zoom_armed);  // Z zooms otherwise
  studio.key(GLFW_KEY_Z);
  CHECK((studio.live().translate - free).norm() < 1e-12);
  studio.key(keys::escape);
  studio.release();
  REQUIRE(studio.settle());
  const ScreenPoint ring = studio.handle("screen_ring");
  studio.drag(ring, ring);
  studio.key(GLFW_KEY_X);
  go_around(studio, studio.space_gizmo().centre, ring, 15, 5);
  CHECK(studio.live().axis == Vec3(1, 0, 0));
  CHECK(studio.live().rotate > 3);
  studio.key(keys::escape);
  studio.release();
  CHECK(studio.settle());
}

}  // namespace winslow::gui::test
