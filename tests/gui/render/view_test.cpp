#include "gui/render/view.h"

#include <doctest/doctest.h>

#include "support/random.h"

namespace winslow::gui::test {

namespace {

PlaneView make_view() {
  Camera camera;
  camera.set_viewport(30, 20, 800, 600);
  camera.look_at({5, -3}, 0.01);
  return PlaneView(camera);
}

}  // namespace

TEST_CASE("The ray through a point's place on screen goes through the point") {
  constexpr std::uint64_t seed = 11;
  CAPTURE(seed);
  winslow::test::Random random(seed);
  const PlaneView view = make_view();
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
  const PlaneView view = make_view();
  const Ray<3> ray = view.unproject({400, 300});
  CHECK(view.project(ray.origin).depth < view.project(ray.origin + ray.direction).depth);
  CHECK(view.project({5, -3, 0}).depth == 0);
}

TEST_CASE("The size of a pixel is what a step of one pixel covers") {
  const PlaneView view = make_view();
  const Vec3 point(5.5, -2.5, 0);
  constexpr double h = 1e-4;
  for (const Vec3& along : {Vec3(1, 0, 0), Vec3(0, 1, 0)}) {
    const double pixels =
        (view.project(point + h * along).at - view.project(point - h * along).at).norm();
    CHECK(view.pixel_size(point) == doctest::Approx(2 * h / pixels).epsilon(1e-9));
  }
}

TEST_CASE("Points of the plane are where the camera has them, to the last bit") {
  const PlaneView view = make_view();
  const Vec2 point(4.123456789, -3.987654321);
  const ScreenPoint at(123.25, 456.75);
  CHECK(view.to_screen(point) == view.camera().to_screen(point));
  CHECK(view.to_plane(at) == view.camera().to_world(at));
  CHECK(view.pixel_size(point) == view.camera().units_per_pixel());
  CHECK(view.viewport() == ScreenBox{{30, 20}, {830, 620}});
}

TEST_CASE("Panning takes what is seen along; zooming leaves a place where it is") {
  PlaneView view = make_view();
  const ScreenPoint at(200, 200);
  const Vec2 grabbed = view.to_plane(at);
  view.pan({35, -20});
  CHECK((view.to_screen(grabbed) - ScreenPoint(235, 180)).norm() < 1e-9);
  view.zoom_at({235, 180}, 3);
  CHECK((view.to_screen(grabbed) - ScreenPoint(235, 180)).norm() < 1e-9);
}

}  // namespace winslow::gui::test
