#include "gui/render/space/star_sketch.h"

#include <doctest/doctest.h>

#include <Eigen/LU>
#include <cmath>
#include <limits>

#include "support/links.h"
#include "support/random.h"

namespace winslow::gui::test {

namespace {

SpaceCamera camera_from(double azimuth, double elevation) {
  SpaceCamera camera;
  camera.set_viewport(0, 0, 400, 400);
  camera.look_from({azimuth, elevation, 2});
  camera.look_at(Vec3(0, 0, 0), 0.01);
  return camera;
}

std::vector<Vec3> octahedron() {
  return {{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
}

/// The depth of what is seen of a triangle at a place; infinite beside it.
double depth_of(const SpaceCamera& camera, const std::vector<Vec3>& points,
                const std::array<Index, 3>& triangle, const ScreenPoint& at) {
  const Ray<3> ray = camera.unproject(at);
  const Vec3 a = points[static_cast<std::size_t>(triangle[0])],
             b = points[static_cast<std::size_t>(triangle[1])],
             c = points[static_cast<std::size_t>(triangle[2])];
  Eigen::Matrix3d m;
  m << b - a, c - a, -ray.direction;
  const Vec3 s = m.partialPivLu().solve(ray.origin - a);
  const bool inside = s[0] > 1e-6 && s[1] > 1e-6 && s[0] + s[1] < 1 - 1e-6;
  return inside ? s[2] : std::numeric_limits<double>::infinity();
}

}  // namespace

TEST_CASE(
    "of an octahedron the four faces towards the viewer are painted last, the lit one lightest") {
  const auto points = octahedron();
  const auto triangles = winslow::test::double_pyramid(4);
  const SpaceCamera camera = camera_from(30, 20);
  const StarSketch sketch(camera, points, triangles);
  REQUIRE(sketch.faces().size() == 8);
  int fronts = 0;
  bool front_began = false;
  for (const auto& face : sketch.faces()) {
    fronts += face.front ? 1 : 0;
    CHECK_FALSE((front_began && !face.front));
    front_began = front_began || face.front;
    CHECK(face.light >= 0);
    CHECK(face.light <= 1);
  }
  CHECK(fronts == 4);
}

TEST_CASE(
    "lines behind a solid are hidden, those on its near side are not, one through it in part") {
  const auto points = octahedron();
  const auto triangles = winslow::test::double_pyramid(4);
  const SpaceCamera camera = camera_from(20, 10);  // from near +x
  const StarSketch sketch(camera, points, triangles);
  const auto all_hidden = [&](const Vec3& a, const Vec3& b) {
    const auto pieces = sketch.cut(a, b);
    return pieces.size() == 1 && pieces.front().hidden;
  };
  const auto all_seen = [&](const Vec3& a, const Vec3& b) {
    const auto pieces = sketch.cut(a, b);
    return pieces.size() == 1 && !pieces.front().hidden;
  };
  CHECK(all_seen(points[0], points[4]));
  CHECK(all_hidden(points[2], points[4]));
  CHECK(all_hidden(points[2], Vec3(-1, 0.1, 0)));
  CHECK_FALSE(sketch.hides(points[0]));
  CHECK(sketch.hides(points[2]));
  CHECK(sketch.hides(Vec3(0, 0, 0)));
  // From far left of it to far right, behind it: seen, hidden, seen.
  const auto pieces = sketch.cut(Vec3(-2, -3, 0), Vec3(-2, 3, 0));
  REQUIRE(pieces.size() == 3);
  CHECK_FALSE(pieces[0].hidden);
  CHECK(pieces[1].hidden);
  CHECK_FALSE(pieces[2].hidden);
  CHECK((pieces[0].b - pieces[1].a).norm() < 1e-9);
}

TEST_CASE(
    "what is painted last at a place is what lies nearest there, on stars that are not convex") {
  winslow::test::Random random(5);
  for (int round = 0; round < 20; ++round) {
    CAPTURE(round);
    auto points = octahedron();
    for (Vec3& p : points) p *= random.uniform(0.25, 1.6);
    auto triangles = winslow::test::double_pyramid(4);
    const SpaceCamera camera = camera_from(random.uniform(0, 360), random.uniform(-80, 80));
    const StarSketch sketch(camera, points, triangles);
    for (int probe = 0; probe < 60; ++probe) {
      const ScreenPoint at(random.uniform(80, 320), random.uniform(80, 320));
      std::size_t nearest = 8, last = 8;
      double least = std::numeric_limits<double>::infinity();
      for (std::size_t t = 0; t < 8; ++t) {
        const double depth = depth_of(camera, points, triangles[t], at);
        if (depth < least) {
          least = depth;
          nearest = t;
        }
      }
      if (nearest == 8) continue;
      for (const auto& face : sketch.faces())
        if (std::isfinite(depth_of(camera, points, triangles[face.triangle], at)))
          last = face.triangle;
      CHECK(last == nearest);
    }
  }
}

}  // namespace winslow::gui::test
