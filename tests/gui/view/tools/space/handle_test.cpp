#include <doctest/doctest.h>

#include <array>

#include "core/quality/quality.h"
#include "gui/support/moving_rig.h"

namespace winslow::gui::test {

namespace {

using Kind = Handle::Kind;

}  // namespace

TEST_CASE(
    "The handle of a body in space: arrows, squares, rings and a centre, lit under the mouse") {
  MovingStudio studio;
  CHECK((studio.gizmo().place.pivot - Vec3(0.5, 0.5, 0.5)).norm() < 1e-12);
  const std::array<std::pair<const char*, Handle>, 11> parts{
      {{"centre", {Kind::centre, 0}},
       {"arrow/x", {Kind::arrow, 0}},
       {"arrow/y", {Kind::arrow, 1}},
       {"arrow/z", {Kind::arrow, 2}},
       {"square/x", {Kind::square, 0}},
       {"square/y", {Kind::square, 1}},
       {"square/z", {Kind::square, 2}},
       {"ring/x", {Kind::ring, 0}},
       {"ring/y", {Kind::ring, 1}},
       {"ring/z", {Kind::ring, 2}},
       {"screen_ring", {Kind::screen_ring, 0}}}};
  for (const auto& part : parts) {
    const char* const id = part.first;
    CAPTURE(id);
    studio.move(studio.handle(id));
    studio.frames();
    CHECK(studio.mover().handle() == part.second);
    CHECK(studio.bench->pane().cursor() == ImGuiMouseCursor_Hand);
    CHECK(studio.session().selection().hovered().empty());  // it is the handle that is meant
  }
  studio.bench->apply(action::SelectMarkers{});
  studio.frames();
  CHECK_FALSE(studio.visible("gizmo/centre"));
}

TEST_CASE(
    "The handle has one size on screen, however near the body is, parallel and in perspective") {
  MovingStudio studio;
  std::vector<double> lengths;
  for (const bool perspective : {false, true}) {
    set_view(studio, [&](ViewOptions& view) { view.space.perspective = perspective; });
    for (const double notches : {0.0, 5.0, -9.0}) {
      studio.wheel(studio.gizmo().centre, notches);
      studio.frames();
      const Gizmo g = studio.gizmo();
      const double sine = g.frame().axes[2].cross(g.viewer).norm();
      lengths.push_back((g.tips[2] - g.centre).norm() / sine);
    }
  }
  for (const double length : lengths) CHECK(length == doctest::Approx(lengths[0]).epsilon(0.06));
}

TEST_CASE("Seen along an axis its arrow is not offered, nor the squares that are seen edge on") {
  MovingStudio studio;
  studio.key(GLFW_KEY_1);  // from +x
  studio.frames();
  CHECK_FALSE(studio.visible("gizmo/arrow/x"));
  CHECK_FALSE(studio.visible("gizmo/square/y"));
  CHECK_FALSE(studio.visible("gizmo/square/z"));
  for (const char* id : {"gizmo/arrow/y", "gizmo/arrow/z", "gizmo/square/x", "gizmo/ring/x"})
    CHECK_MESSAGE(studio.visible(id), id);
  // Arrows point along the axes, from whichever side one looks.
  for (const int key : {GLFW_KEY_1, GLFW_KEY_2}) {
    studio.key(key);
    const Gizmo g = studio.gizmo();
    CHECK(g.tips[2].y() < g.centre.y());
    CHECK((g.tips[1].x() > g.centre.x()) == (key == GLFW_KEY_1));
  }
}

TEST_CASE("An arrow moves the body along its axis, the mesh follows, and it becomes one command") {
  MovingStudio studio;
  const Coordinates before = studio.mesh().coordinates;
  const ScreenPoint from = studio.handle("arrow/x");
  const ScreenVector along = from - studio.gizmo().centre;
  studio.drag(from, from + 0.8 * along);
  CHECK(studio.session().dragging());
  studio.follow();
  CHECK(check_validity(*studio.mesh().topology, studio.session().coordinates()).inverted == 0);
  CHECK(studio.session().coordinates() != before);
  const Vec3 way = studio.live().translate;
  CHECK(way.x() > 0.01);
  CHECK(way.y() == 0);
  CHECK(way.z() == 0);
  // What was taken stays under the mouse.
  CHECK((studio.handle("arrow/x") - (from + 0.8 * along)).norm() < 1.5);
  studio.release();
  REQUIRE(studio.settle());
  REQUIRE(studio.document().history().position() == 1);
  CHECK(studio.last_motion().translate == way);
  CHECK(studio.last_motion().rotate == 0);
  for (const Index node : studio.mesh().topology->markers().nodes(studio.marker("body")))
    CHECK((studio.mesh().coordinates.xyz(node) - before.xyz(node) - way).norm() < 1e-12);
  studio.check_replay();
  CHECK((studio.session().selection().space_pivot() - Vec3(0.5, 0.5, 0.5) - way).norm() < 1e-12);
  studio.key(keys::z, {keys::control});
  REQUIRE(studio.settle());
  CHECK(studio.mesh().coordinates == before);
  CHECK((studio.session().selection().space_pivot() - Vec3(0.5, 0.5, 0.5)).norm() < 1e-12);
}

TEST_CASE("A square moves in its plane, the disc across the view") {
  MovingStudio studio;
  const ScreenPoint square = studio.handle("square/y");
  studio.drag(square, square + ScreenVector(24, -9));
  CHECK(studio.live().translate.y() == 0);
  CHECK(studio.live().translate.x() != 0);
  CHECK(studio.live().translate.z() != 0);
  CHECK((studio.handle("square/y") - square - ScreenVector(24, -9)).norm() < 1.5);
  studio.key(keys::escape);
  studio.release();
  REQUIRE(studio.settle());
  const ScreenPoint centre = studio.handle("centre");
  studio.drag(centre, centre + ScreenVector(-20, 15));
  const Vec3 way = studio.live().translate;
  CHECK(std::abs(way.dot(studio.view().back())) < 1e-12);
  CHECK(pixels(studio, way) == doctest::Approx(25));
  CHECK((studio.handle("centre") - centre - ScreenVector(-20, 15)).norm() < 1e-6);
  studio.release();
  REQUIRE(studio.settle());
  CHECK(studio.document().history().position() == 1);
}

TEST_CASE("In perspective, too, what was taken stays under the mouse") {
  MovingStudio studio;
  set_view(studio, [](ViewOptions& view) { view.space.perspective = true; });
  studio.frames();
  for (const char* id : {"arrow/y", "square/z", "centre"}) {
    CAPTURE(id);
    const ScreenPoint from = studio.handle(id);
    const ScreenVector by =
        std::string(id) == "arrow/y" ? 0.6 * (from - studio.gizmo().centre) : ScreenVector(18, 11);
    studio.drag(from, from + by);
    // The handle keeps its size, the place that was taken on it does not quite.
    CHECK((studio.handle(id) - (from + by)).norm() < 4);
    studio.key(keys::escape);
    studio.release();
    REQUIRE(studio.settle());
  }
}

TEST_CASE("A ring turns about its axis, and goes on counting past half a turn and back") {
  MovingStudio studio;
  studio.key(GLFW_KEY_5);  // from +z: the ring about z is seen as it is
  studio.frames();
  const ScreenPoint centre = studio.gizmo().centre;
  const ScreenPoint from = studio.handle("ring/z");
  studio.drag(from, from);
  go_around(studio, centre, from, 300, 40);
  CHECK(studio.live().rotate == doctest::Approx(300).epsilon(1e-3));
  CHECK(studio.live().axis == Vec3(0, 0, 1));
  CHECK((*studio.live().pivot - Vec3(0.5, 0.5, 0.5)).norm() < 1e-12);
  CHECK(studio.live().translate == Vec3(0, 0, 0));
  go_around(studio, centre, around(centre, from, 300), -290, 40);
  CHECK(studio.live().rotate == doctest::Approx(10).epsilon(0.02));
  studio.follow();
  const double turned = studio.live().rotate;
  studio.release();
  REQUIRE(studio.settle());
  CHECK(studio.last_motion().rotate == turned);
  studio.check_replay();
}

TEST_CASE("A ring that is seen edge on turns as the mouse goes along it") {
  MovingStudio studio;
  studio.key(GLFW_KEY_1);  // from +x: the ring about z is a horizontal line
  studio.frames();
  const Gizmo g = studio.gizmo();
  const ScreenPoint from = g.centre + ScreenVector(-0.6 * g.ring_radius, 0);
  studio.move(from);
  studio.frames();
  REQUIRE(studio.mover().handle() == Handle{Kind::ring, 2});
  studio.drag(from, from + ScreenVector(0.3 * g.ring_radius, 0));
  // Its near side goes with the mouse: from +x, to the right is +y.
  CHECK(studio.live().rotate == doctest::Approx(degrees(0.3)).epsilon(1e-6));
  studio.move(from + ScreenVector(0.3 * g.ring_radius, 40));
  CHECK(studio.live().rotate == doctest::Approx(degrees(0.3)).epsilon(1e-6));
  // Past a quarter and half a turn, nothing flips.
  for (int k = 1; k <= 40; ++k) studio.move(from + ScreenVector(-0.1 * k * g.ring_radius, 0));
  CHECK(studio.live().rotate == doctest::Approx(degrees(-4)).epsilon(1e-6));
  studio.key(keys::escape);
  studio.release();
  CHECK(studio.settle());
}

TEST_CASE("The screen ring turns about the line of sight") {
  MovingStudio studio;
  const ScreenPoint centre = studio.gizmo().centre;
  const ScreenPoint from = studio.handle("screen_ring");
  studio.drag(from, from);
  go_around(studio, centre, from, 20, 5);
  CHECK(studio.live().rotate == doctest::Approx(20).epsilon(1e-3));
  CHECK((*studio.live().axis - studio.view().back()).norm() < 1e-9);
  studio.release();
  REQUIRE(studio.settle());
  CHECK(studio.document().history().position() == 1);
  studio.check_replay();
}

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
  const ViewDirection looked = studio.view().direction();
  const ScreenPoint ring = studio.handle("ring/y");
  studio.drag(ring, ring + ScreenVector(6, 6));
  studio.key(GLFW_KEY_3);  // as a keyboard does: the key, and its character
  studio.type("3");
  studio.key(GLFW_KEY_0);
  studio.type("0");
  CHECK(studio.live().rotate == 30);
  CHECK(studio.live().axis == Vec3(0, 1, 0));
  CHECK(studio.view().direction() == looked);  // 3 looks from +y otherwise
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

  const ScreenPoint ring = studio.handle("screen_ring"), centre = studio.gizmo().centre;
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
  go_around(studio, studio.gizmo().centre, ring, 15, 5);
  CHECK(studio.live().axis == Vec3(1, 0, 0));
  CHECK(studio.live().rotate > 3);
  studio.key(keys::escape);
  studio.release();
  CHECK(studio.settle());
}

}  // namespace winslow::gui::test
