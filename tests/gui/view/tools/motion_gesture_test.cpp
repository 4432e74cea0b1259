#include "gui/view/tools/motion_gesture.h"

#include <doctest/doctest.h>

#include <cmath>

namespace winslow::gui {

namespace {

PlaneView plane() {
  Camera c;
  c.set_viewport(0, 0, 800, 600);
  c.look_at(Vec2(0, 0), 0.01);
  return PlaneView(c);
}

}  // namespace

TEST_CASE("the grid is a round number of units, 8 to 20 pixels wide, at any zoom") {
  PlaneView c = plane();
  for (double zoom = 1e-6; zoom < 1e6; zoom *= 1.7) {
    c.camera().look_at(Vec2(0, 0), zoom);
    const double step = MotionGesture::grid_step(c, Vec2(0, 0));
    CHECK(step >= 8 * zoom);
    CHECK(step <= 20 * zoom * (1 + 1e-12));
    const double digit = step / std::pow(10, std::floor(std::log10(step * (1 + 1e-12))));
    CAPTURE(digit);
    CHECK((std::abs(digit - 1) < 1e-9 || std::abs(digit - 2) < 1e-9 || std::abs(digit - 5) < 1e-9));
  }
}

TEST_CASE("fine motion adds up with coarse, and does not jump when Shift goes") {
  const PlaneView c = plane();
  MotionGesture drag;
  drag.begin(MotionGesture::Kind::move, ScreenPoint(100, 100), Vec2(0, 0), {});
  CHECK(drag.follow(ScreenPoint(200, 100), {}, c));
  CHECK(drag.motion().translate.x() == doctest::Approx(1));
  CHECK(drag.follow(ScreenPoint(300, 100), {true, false}, c));
  CHECK(drag.motion().translate.x() == doctest::Approx(1.1));
  CHECK_FALSE(drag.follow(ScreenPoint(300, 100), {}, c));
  CHECK(drag.follow(ScreenPoint(310, 100), {}, c));
  CHECK(drag.motion().translate.x() == doctest::Approx(1.2));
}

TEST_CASE("a lock keeps the other axis at nothing and forgets nothing") {
  const PlaneView c = plane();
  MotionGesture drag;
  drag.begin(MotionGesture::Kind::move, ScreenPoint(100, 100), Vec2(0, 0), 1);
  drag.follow(ScreenPoint(150, 70), {}, c);
  CHECK(drag.motion().translate == Vec2(0, drag.motion().translate.y()));
  CHECK(drag.motion().translate.y() == doctest::Approx(0.3));
  drag.toggle_axis(1);
  drag.follow(ScreenPoint(150, 70), {}, c);
  CHECK(drag.motion().translate.x() == doctest::Approx(0.5));
  drag.toggle_axis(0);
  drag.follow(ScreenPoint(150, 70), {}, c);
  CHECK(drag.motion().translate.y() == 0);
}

TEST_CASE("turns are counted past half a turn and snapped in total") {
  const PlaneView c = plane();
  MotionGesture drag;
  const Vec2 pivot(0, 0);
  const auto at = [&](double degrees) -> ScreenPoint {
    const double t = radians(degrees);
    return c.to_screen(Vec2(std::cos(t), std::sin(t)));
  };
  drag.begin(MotionGesture::Kind::rotate, at(0), pivot, {});
  for (int k = 1; k <= 53; ++k) drag.follow(at(10.0 * k), {}, c);
  CHECK(drag.motion().rotate == doctest::Approx(530));
  drag.follow(at(532), {false, true}, c);
  CHECK(drag.motion().rotate == 530);
  CHECK(drag.motion().pivot == pivot);
}

}  // namespace winslow::gui
