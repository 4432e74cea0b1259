#include "gui/render/space/space_view.h"

#include <doctest/doctest.h>

#include <Eigen/Geometry>

#include "support/random.h"

using namespace winslow;
using namespace winslow::gui;
using winslow::test::Random;

namespace {

Vec3 random_point(Random& random) {
  return {random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
}

/// A camera that sees the cube around the origin from somewhere.
SpaceCamera random_camera(Random& random, bool perspective) {
  SpaceCamera camera;
  camera.set_viewport(20, 30, 400, 300);
  camera.look_from({random.uniform(-180, 180), random.uniform(-90, 90)});
  if (perspective) camera.set_perspective(random.uniform(10, 60));
  camera.look_at(0.2 * random_point(random), 0.02);
  camera.set_content({Vec3::Constant(-1), Vec3::Constant(1)});
  return camera;
}

}  // namespace

TEST_CASE("What the graphics card makes of a point is where the camera projects it") {
  Random random(3);
  for (int k = 0; k < 200; ++k) {
    const SpaceCamera camera = random_camera(random, k % 2 == 0);
    const Vec3 origin = random_point(random), p = random_point(random);
    const auto m = camera.matrix(origin);
    const Eigen::Vector4f clip =
        Eigen::Map<const Eigen::Matrix4f>(m.data()) * (p - origin).cast<float>().homogeneous();
    const auto [at, depth] = camera.project(p);
    CHECK(20 + 200 * (1 + static_cast<double>(clip.x() / clip.w())) ==
          doctest::Approx(at.x()).epsilon(1e-4));
    CHECK(30 + 150 * (1 - static_cast<double>(clip.y() / clip.w())) ==
          doctest::Approx(at.y()).epsilon(1e-4));
    CHECK(std::abs(clip.z()) <= clip.w());  // neither too near nor too far
    CHECK(static_cast<double>(clip.w()) * camera.units_per_pixel() ==
          doctest::Approx(camera.pixel_size(p)).epsilon(1e-4));
  }
}

TEST_CASE("Depth on the graphics card grows away from the viewer, by what pixel_depth() says") {
  Random random(4);
  for (int k = 0; k < 50; ++k) {
    const SpaceCamera camera = random_camera(random, k % 2 == 0);
    const auto m = camera.matrix(Vec3::Zero());
    const Eigen::Matrix4d to_clip = Eigen::Map<const Eigen::Matrix4f>(m.data()).cast<double>();
    const auto depth = [&](const Vec3& p) {
      const Eigen::Vector4d clip = to_clip * p.homogeneous();
      return clip.z() / clip.w();
    };
    const Vec3 p = random_point(random);
    constexpr double h = 1e-4;
    const double slope = (depth(p + h * camera.back()) - depth(p - h * camera.back())) / (2 * h);
    const auto [constant, linear] = camera.pixel_depth();
    CHECK(slope < 0);
    CHECK(slope * camera.pixel_size(p) ==
          doctest::Approx(constant + linear * depth(p)).epsilon(1e-5));
  }
}

TEST_CASE("A ray through a place on screen meets what is projected there") {
  Random random(5);
  for (int k = 0; k < 100; ++k) {
    const SpaceCamera camera = random_camera(random, k % 2 == 0);
    const Vec3 p = random_point(random);
    const auto [origin, direction] = camera.unproject(camera.project(p).at);
    const Vec3 to = p - origin;
    CHECK(to.cross(direction).norm() < 1e-9 * to.norm());
    CHECK(to.dot(direction) > 0);
  }
}

TEST_CASE("Points fit into the viewport, and touch its margins") {
  Random random(6);
  for (int k = 0; k < 100; ++k) {
    SpaceCamera camera = random_camera(random, k % 2 == 0);
    std::vector<Vec3> points;
    for (int i = 0; i < 30; ++i) points.push_back(Vec3(7, -3, 2) + 0.3 * random_point(random));
    camera.fit(points, 0.1);
    double nearest = 1e9;  // to the viewport's sides
    for (const Vec3& p : points) {
      const ScreenPoint at = camera.project(p).at;
      for (const double gap : {at.x() - 20, 420 - at.x(), at.y() - 30, 330 - at.y()})
        nearest = std::min(nearest, gap);
    }
    CHECK(nearest > 29);
    // The points' middle is the middle of the picture, in perspective nearly.
    CHECK(nearest < (k % 2 == 0 ? 60.0 : 40.1));
  }
}

TEST_CASE("Directions to look from: the axis that is asked for is up on screen") {
  SpaceCamera camera;
  const auto axes = [&](double azimuth, double elevation, const Vec3& right, const Vec3& up,
                        int axis = 2) {
    camera.look_from({azimuth, elevation, axis});
    CHECK((camera.right() - right).norm() < 1e-12);
    CHECK((camera.up() - up).norm() < 1e-12);
    CHECK((camera.back() - right.cross(up)).norm() < 1e-12);
  };
  axes(0, 0, {0, 1, 0}, {0, 0, 1});
  axes(-90, 0, {1, 0, 0}, {0, 0, 1});
  axes(-90, 90, {1, 0, 0}, {0, 1, 0});
  axes(-90, -90, {1, 0, 0}, {0, -1, 0});
  axes(0, 0, {1, 0, 0}, {0, 1, 0}, 1);
  axes(90, 0, {0, 0, -1}, {0, 1, 0}, 1);
  axes(0, 0, {0, 0, 1}, {1, 0, 0}, 0);
}

TEST_CASE("A direction is that of the vector to the viewer, whichever axis is up") {
  Random random(7);
  for (int k = 0; k < 60; ++k) {
    const Vec3 to = random_point(random);
    const ViewDirection direction = direction_towards(to, k % 3);
    CHECK((to_viewer(direction) - to.normalized()).norm() < 1e-12);
    SpaceCamera camera;
    camera.look_from(direction);
    CHECK((camera.back() - to.normalized()).norm() < 1e-12);
    CHECK(std::abs(camera.right()[k % 3]) < 1e-12);
    CHECK(camera.up()[k % 3] > 0);
  }
}

TEST_CASE("A camera keeps its place when it is told what is no place") {
  SpaceCamera camera;
  camera.look_at({1, 2, 3}, 0.5);
  camera.look_at({1, std::nan(""), 3}, 0.5);
  camera.look_at({0, 0, 0}, 0);
  CHECK(camera.centre() == Vec3(1, 2, 3));
  CHECK(camera.units_per_pixel() == 0.5);
}
