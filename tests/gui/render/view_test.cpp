#include "gui/render/view.h"

#include <doctest/doctest.h>

#include "support/random.h"

using namespace winslow;
using gui::Camera;
using gui::ScreenPoint;
using gui::ScreenVector;

namespace winslow::gui::test {

namespace {

Camera make_view() {
  Camera camera;
  camera.set_viewport(30, 20, 800, 600);
  camera.look_at({5, -3}, 0.01);
  return camera;
}

}  // namespace

TEST_CASE("The ray through a point's place on screen goes through the point") {
  constexpr std::uint64_t seed = 11;
  CAPTURE(seed);
  winslow::test::Random random(seed);
  const Camera view = make_view();
  for (int k = 0; k < 100; ++k) {
    const Vec3 point(random.uniform(1, 9), random.uniform(-6, 0), random.uniform(-1, 0.9));
    const View::Projection seen = view.project(point);
    const Ray<3> ray = view.unproject(seen.at);
    const double t = (point - ray.origin).dot(ray.direction) / ray.direction.squaredNorm();
    CHECK(t > 0);
    CHECK((ray.origin + t * ray.direction - point).norm() < 1e-12);
    CHECK((view.project(ray.origin + 2 * ray.direction).at - seen.at).norm() < 1e-9);
  }
}

TEST_CASE("Depth grows away from the viewer, along the ray") {
  const Camera view = make_view();
  const Ray<3> ray = view.unproject({400, 300});
  CHECK(view.project(ray.origin).depth < view.project(ray.origin + ray.direction).depth);
  CHECK(view.project({5, -3, 0}).depth == 0);
}

TEST_CASE("The size of a pixel is what a step of one pixel covers") {
  const Camera view = make_view();
  const Vec3 point(5.5, -2.5, 0);
  constexpr double h = 1e-4;
  for (const Vec3& along : {Vec3(1, 0, 0), Vec3(0, 1, 0)}) {
    const double pixels =
        (view.project(point + h * along).at - view.project(point - h * along).at).norm();
    CHECK(view.pixel_size(point) == doctest::Approx(2 * h / pixels).epsilon(1e-9));
  }
}

TEST_CASE("Points of the plane are where the camera has them, to the last bit") {
  const Camera view = make_view();
  const Vec2 point(4.123456789, -3.987654321);
  const ScreenPoint at(123.25, 456.75);
  const View& seen = view;
  CHECK(seen.to_screen(point) == view.to_screen(point));
  CHECK(seen.to_plane(at) == view.to_world(at));
  CHECK(seen.pixel_size(point) == view.units_per_pixel());
  CHECK(seen.viewport() == ScreenBox{{30, 20}, {830, 620}});
}

TEST_CASE("Panning takes what is seen along; zooming leaves a place where it is") {
  Camera view = make_view();
  const ScreenPoint at(200, 200);
  const Vec2 grabbed = view.to_plane(at);
  view.pan_at({grabbed.x(), grabbed.y(), 0}, {35, -20});
  CHECK((view.to_screen(grabbed) - ScreenPoint(235, 180)).norm() < 1e-9);
  view.zoom_about({grabbed.x(), grabbed.y(), 0}, 3);
  CHECK((view.to_screen(grabbed) - ScreenPoint(235, 180)).norm() < 1e-9);
}

}  // namespace winslow::gui::test

namespace {

Camera make_camera() {
  Camera camera;
  camera.set_viewport(30, 20, 800, 600);
  camera.look_at({5, -3}, 0.01);
  return camera;
}

}  // namespace

TEST_CASE("The camera's centre is the middle of the viewport, and y points up") {
  const Camera camera = make_camera();
  CHECK((camera.to_screen({5, -3}) - ScreenPoint(430, 320)).norm() < 1e-9);
  CHECK((camera.to_screen({6, -2}) - ScreenPoint(530, 220)).norm() < 1e-9);
  CHECK((camera.to_world({430, 320}) - Vec2(5, -3)).norm() < 1e-12);
}

TEST_CASE("Screen and world are inverse to each other") {
  constexpr std::uint64_t seed = 7;
  CAPTURE(seed);
  winslow::test::Random random(seed);
  Camera camera = make_camera();
  for (int k = 0; k < 200; ++k) {
    camera.look_at(100 * random.vector(), std::pow(10.0, random.uniform(-8, 2)));
    const ScreenPoint screen(random.uniform(0, 1000), random.uniform(0, 1000));
    CHECK((camera.to_screen(camera.to_world(screen)) - screen).norm() < 1e-4);
  }
}

TEST_CASE("Zooming keeps the point under the cursor, to a millionfold and back") {
  Camera camera = make_camera();
  const ScreenPoint cursor(123, 456);
  const Vec2 before = camera.to_world(cursor);
  for (int k = 0; k < 20; ++k) camera.zoom_at(cursor, 2);
  CHECK(camera.units_per_pixel() == doctest::Approx(0.01 / 1048576));
  CHECK((camera.to_screen(before) - cursor).norm() < 1e-6);
  for (int k = 0; k < 20; ++k) camera.zoom_at(cursor, 0.5);
  CHECK((camera.centre() - Vec2(5, -3)).norm() < 1e-9);
}

TEST_CASE("Panning moves the world with the mouse") {
  Camera camera = make_camera();
  const Vec2 grabbed = camera.to_world({200, 200});
  camera.pan({40, -25});
  CHECK((camera.to_world({240, 175}) - grabbed).norm() < 1e-12);
}

TEST_CASE("Fitting shows a box whole, with its margin") {
  Camera camera = make_camera();
  for (const Vec2& size : {Vec2(10, 1), Vec2(1, 10), Vec2(4, 3)}) {
    const Bounds box{{-2, 7}, Vec2(-2, 7) + size};
    camera.fit(box, 0.05);
    const ScreenPoint low = camera.to_screen({box.min.x(), box.max.y()});
    const ScreenPoint high = camera.to_screen({box.max.x(), box.min.y()});
    CHECK(low.x() >= 30 + 0.05 * 800 - 1e-6);
    CHECK(high.x() <= 830 - 0.05 * 800 + 1e-6);
    CHECK(low.y() >= 20 + 0.05 * 600 - 1e-6);
    CHECK(high.y() <= 620 - 0.05 * 600 + 1e-6);
    const bool touches_x = std::abs(low.x() - 70) < 1e-6;
    const bool touches_y = std::abs(low.y() - 50) < 1e-6;
    CHECK((touches_x || touches_y));
    CHECK((midpoint(low, high) - ScreenPoint(430, 320)).norm() < 1e-6);
  }
}

TEST_CASE("A single point can be fitted, and nonsense is ignored") {
  Camera camera = make_camera();
  camera.fit({{3, 3}, {3, 3}});
  CHECK((camera.centre() - Vec2(3, 3)).norm() == 0);
  CHECK(camera.units_per_pixel() > 0);
  const double before = camera.units_per_pixel();
  camera.zoom_at({10, 10}, 0);
  camera.zoom_at({10, 10}, std::nan(""));
  camera.look_at({std::nan(""), 0}, 1);
  camera.look_at({0, 0}, -1);
  CHECK(camera.units_per_pixel() == before);
  CHECK((camera.centre() - Vec2(3, 3)).norm() == 0);
}

TEST_CASE("The visible box is what the corners of the viewport see") {
  const Camera camera = make_camera();
  const Bounds seen = camera.visible();
  CHECK((seen.min - camera.to_world({30, 620})).norm() < 1e-12);
  CHECK((seen.max - camera.to_world({830, 20})).norm() < 1e-12);
}

TEST_CASE("The matrix takes positions relative to an origin to the same place as to_screen") {
  Camera camera = make_camera();
  camera.look_at({1e3 + 1e-7, 2e3}, 1e-9);
  const Vec2 origin(1e3, 2e3);
  const auto m = camera.matrix({origin.x(), origin.y(), 0});
  const Vec2 world(1e3 + 3e-7, 2e3 - 1e-7);
  const Vec2 relative = world - origin;
  const double clip_x = m[0] * relative.x() + m[12];
  const double clip_y = m[5] * relative.y() + m[13];
  const ScreenPoint screen(30 + 400 * (clip_x + 1), 20 + 300 * (1 - clip_y));
  CHECK((screen - camera.to_screen(world)).norm() < 0.01);
}

TEST_CASE("A part of the framebuffer shows the same points at the same pixels") {
  const Camera camera = make_camera();  // its viewport: 30 to 830 by 20 to 620
  const auto part = gui::part_of(camera, {{500, 300}, {900, 700}});
  REQUIRE(part);
  CHECK(part->viewport_origin() == ScreenPoint(0, 0));
  CHECK(part->viewport_width() == 330);
  CHECK(part->viewport_height() == 320);
  const Vec2 point(6.2, -4.1);
  CHECK((part->to_screen(point) + ScreenVector(500, 300) - camera.to_screen(point)).norm() < 1e-9);
  CHECK_FALSE(gui::part_of(camera, {{0, 0}, {30, 700}}));
}
