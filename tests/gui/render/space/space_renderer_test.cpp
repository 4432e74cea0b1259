#include "gui/render/space/space_renderer.h"

#include <doctest/doctest.h>

#include <Eigen/Geometry>

#include "gui/support/scene.h"

using namespace winslow;
using namespace winslow::gui;
using namespace winslow::gui::test;

namespace {

constexpr Rgb red{1, 0, 0}, green{0, 1, 0}, blue{0, 0, 1};

/// A square across the view of this half width; tilt: how far its upper edge lies behind its
/// lower one, over its height.
SpaceFill sheet(double y, double half, const Rgb& color, double tilt = 0) {
  const Vec3 a(-half, y - tilt * half, -half), b(half, y - tilt * half, -half);
  const Vec3 c(half, y + tilt * half, half), d(-half, y + tilt * half, half);
  const Vec3 normal = (b - a).cross(d - a).normalized();
  SpaceFill fill;
  for (const Vec3& p : {a, b, c, a, c, d}) {
    const Eigen::Vector3f q = p.cast<float>(), n = normal.cast<float>();
    fill.corners.push_back({{q.x(), q.y(), q.z()}, {n.x(), n.y(), n.z()}, pack_color(color)});
  }
  return fill;
}

SpaceLines segment(const Vec3& a, const Vec3& b, float width = 2) {
  SpaceLines lines;
  for (const Vec3& p : {a, b}) {
    const Eigen::Vector3f q = p.cast<float>();
    lines.ends.push_back({{q.x(), q.y(), q.z()}, 0});
  }
  lines.width = width;
  return lines;
}

SpaceScene scene_of(std::vector<SpaceFill> fills, std::vector<SpaceLines> lines = {}) {
  SpaceScene scene;
  scene.extent = {Vec3::Constant(-1), Vec3::Constant(1)};
  scene.fills = std::move(fills);
  scene.lines = std::move(lines);
  return scene;
}

}  // namespace

TEST_CASE("What lies nearer hides what is behind it, whichever comes first, also in perspective") {
  SpaceRig rig;
  for (const double angle : {0.0, 40.0}) {
    rig.camera.set_perspective(angle);
    const SpaceFill near = sheet(-0.5, 0.3, red), far = sheet(0.5, 0.8, green);
    for (const auto& fills : {std::vector{near, far}, std::vector{far, near}}) {
      const Image image = rig.draw(scene_of(fills));
      CHECK(distance(rig.color(image, {0, -0.5, 0}), red) < 0.01);
      CHECK(distance(rig.color(image, {0.6, 0.5, 0.1}), green) < 0.01);
    }
  }
}

TEST_CASE("Surfaces that pass through each other meet where they do in space") {
  SpaceRig rig;
  const Image image = rig.draw(scene_of({sheet(0, 0.8, red), sheet(0, 0.8, blue, 0.5)}));
  CHECK(distance(rig.color(image, {0, 0, -0.3}), blue) < 0.01);  // its lower half comes nearer
  CHECK(distance(rig.color(image, {0, 0, 0.3}), red) < 0.01);
}

TEST_CASE("A line on a face is drawn along all of it, whatever the face's slope") {
  SpaceRig rig;
  for (const double angle : {0.0, 40.0}) {
    for (const double tilt : {0.0, 0.7, 3.0}) {
      CAPTURE(tilt);
      rig.camera.set_perspective(angle);
      SpaceScene scene = scene_of({sheet(0, 0.5, white, tilt)},
                                  {segment({-0.1, -0.4 * tilt, -0.4}, {-0.05, 0.4 * tilt, 0.4}),
                                   segment({-0.4, 0.3 * tilt, 0.3}, {0.4, 0.3 * tilt, 0.3}, 1.0f)});
      scene.extent = {Vec3::Constant(-2), Vec3::Constant(2)};
      rig.camera.set_content(scene.extent);
      const Image image = rig.draw(scene);
      for (double t = 0.02; t < 1; t += 0.02) {
        // The darkest pixel near the axis: it runs between pixels.
        const auto darkest = [&](const Vec3& p) {
          double least = 1;
          for (const double dx : {-1.0, 0.0, 1.0})
            for (const double dy : {-1.0, 0.0, 1.0})
              least = std::min(least,
                               color_at(image, rig.camera.project(p).at + ScreenVector(dx, dy))[1]);
          return least;
        };
        CHECK(darkest({-0.1 + 0.05 * t, tilt * (-0.4 + 0.8 * t), -0.4 + 0.8 * t}) < 0.35);
        CHECK(darkest({-0.4 + 0.8 * t, tilt * 0.3, 0.3}) < 0.55);
      }
    }
  }
}

TEST_CASE("Lines behind a surface are hidden, those before it are not") {
  SpaceRig rig;
  for (const double angle : {0.0, 40.0}) {
    rig.camera.set_perspective(angle);
    const Image image = rig.draw(
        scene_of({sheet(0, 0.6, white)}, {segment({-0.5, 0.01, 0.2}, {0.5, 0.01, 0.2}),
                                          segment({-0.5, -0.01, -0.2}, {0.5, -0.01, -0.2})}));
    CHECK(rig.color(image, {0, 0.01, 0.2})[0] > 0.99);
    CHECK(rig.color(image, {0, -0.01, -0.2})[0] < 0.2);
  }
}

TEST_CASE("Lines that end behind the viewer are drawn as far as he sees them") {
  SpaceRig rig;
  rig.camera.set_perspective(60);  // he is less than two units away
  SpaceScene scene = scene_of({}, {segment({0, 0.5, -0.5}, {0, -9, -0.5}, 3)});
  scene.extent = {Vec3(-1, -9, -1), Vec3(1, 1, 1)};
  rig.camera.set_content(scene.extent);
  const Image image = rig.draw(scene);
  for (const double y : {0.4, 0.0, -0.4, -0.6}) CHECK(rig.color(image, {0, y, -0.5})[0] < 0.2);
  CHECK(rig.color(image, {0, 0.4, 0.5})[0] > 0.99);
}

TEST_CASE("What lies in front of a plane is left out where it is asked for") {
  SpaceRig rig;
  SpaceScene scene = scene_of({sheet(0, 0.8, red), sheet(0.2, 0.8, green)},
                              {segment({-0.7, -0.1, 0.1}, {0.7, -0.1, 0.1})});
  scene.planes = {Plane({0, 0, 0}, {0, 0, 1}), Plane({0.3, 0, 0}, {1, 0, 0})};
  scene.fills[0].clipped_by = 2;
  scene.lines[0].clipped_by = 2;
  const Image image = rig.draw(scene);
  CHECK(distance(rig.color(image, {0, 0, 0.4}), red) < 0.01);  // the first plane is not its affair
  CHECK(distance(rig.color(image, {0.25, 0, 0.4}), red) < 0.01);
  CHECK(distance(rig.color(image, {0.4, 0, 0.4}), green) < 0.01);
  CHECK(rig.color(image, {0, 0, 0.1})[0] < 0.2);
  CHECK(distance(rig.color(image, {0.5, 0, 0.1}), green) < 0.01);
}

TEST_CASE("Of what is see-through one layer is seen, over what lies behind") {
  SpaceRig rig;
  SpaceFill both = sheet(-0.2, 0.5, red);
  const SpaceFill second = sheet(-0.4, 0.5, red);
  both.corners.insert(both.corners.end(), second.corners.begin(), second.corners.end());
  both.opacity = 0.5f;
  const Image image = rig.draw(scene_of({both, sheet(0.5, 0.2, green)}));
  CHECK(distance(rig.color(image, {0, 0, 0}), {0.5f, 0.5f, 0}) < 0.02);
  CHECK(distance(rig.color(image, {0.4, 0, 0.4}), {1, 0.5f, 0.5f}) < 0.02);
}

TEST_CASE(
    "What is emphasised is seen through what hides it, and wins over what lies in its place") {
  SpaceRig rig;
  SpaceFill worst = sheet(0.2, 0.2, red);
  worst.emphasised = true;
  const Image hidden = rig.draw(scene_of({sheet(0, 0.6, white), worst}));
  const auto color = rig.color(hidden, {0, 0, 0});
  CHECK(color[0] > 0.99);
  CHECK(color[1] < 0.9);
  CHECK(color[1] > 0.5);
  for (const double tilt : {0.0, 2.0}) {
    SpaceFill same = sheet(0, 0.4, red, tilt);
    same.emphasised = true;
    const Image image = rig.draw(scene_of({same, sheet(0, 0.4, green, tilt)}));
    for (double z = -0.35; z < 0.35; z += 0.05)
      CHECK(distance(rig.color(image, {0.1, tilt * z, z}), red) < 0.01);
  }
}

TEST_CASE("Light shows how a surface lies, where it is asked to, from either side") {
  SpaceRig rig;
  const auto brightness = [&](double tilt, float shading, bool turned) {
    SpaceFill fill = sheet(0, 0.6, white, tilt);
    fill.shading = shading;
    if (turned)
      for (SpaceCorner& corner : fill.corners)
        for (float& n : corner.normal) n = -n;
    return rig.color(rig.draw(scene_of({fill})), {0.05, 0, 0.05})[0];
  };
  CHECK(brightness(0, 1, false) > 0.9);
  CHECK(brightness(-2.5, 1, false) < 0.8);
  CHECK(brightness(-2.5, 1, false) == doctest::Approx(brightness(-2.5, 1, true)));
  CHECK(brightness(-2.5, 0, false) > 0.99);
}

TEST_CASE("Lines closer together than can be told apart fade") {
  SpaceRig rig;
  SpaceLines lines = segment({-0.5, 0, 0}, {0.5, 0, 0});
  const auto ink = [&](float spacing) {
    for (auto& end : lines.ends) end.spacing = spacing;
    return 1 - rig.color(rig.draw(scene_of({}, {lines})), {0, 0, 0.004})[0];
  };
  CHECK(ink(0) > 0.8);
  CHECK(ink(1) == doctest::Approx(ink(0)));
  CHECK(ink(0.05f) < 0.6 * ink(0));  // five pixels
  CHECK(ink(0.003f) == 0);
}
