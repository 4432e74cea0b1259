#pragma once

#include <array>
#include <cmath>
#include <memory>

#include "core/mesh/mesh.h"
#include "gui/render/frame_buffer.h"
#include "gui/render/gl.h"
#include "gui/render/mesh_renderer.h"
#include "gui/render/space/space_renderer.h"

namespace winslow::gui::test {

inline constexpr Rgb white{1, 1, 1};

/// A mesh drawn into an off-screen picture: white ground, camera in its middle, one pixel a unit of
/// 1/side unless the test looks elsewhere.
class Scene {
 public:
  explicit Scene(int side = 200, int samples = 4)
      : context(make_headless_context()), target(side, side, samples), side_(side) {
    camera.set_viewport(0, 0, side, side);
  }

  void show(const Mesh& mesh) {
    renderer.set_mesh(mesh.topology, mesh.coordinates);
    camera.fit(bounds(mesh));
  }

  Image draw(const MeshStyle& style) {
    target.clear({1, 1, 1, 1});
    renderer.draw(camera, style, side_);
    return target.read();
  }

 private:
  std::unique_ptr<HeadlessContext> context;

 public:
  FrameBuffer target;
  MeshRenderer renderer;
  Camera camera;

 private:
  int side_;
};

/// Red, green and blue of a pixel in [0, 1].
inline std::array<double, 3> color_at(const Image& image, const ScreenPoint& at) {
  const auto* p =
      image.pixel(static_cast<int>(std::floor(at.x())), static_cast<int>(std::floor(at.y())));
  return {p[0] / 255.0, p[1] / 255.0, p[2] / 255.0};
}

/// Largest difference of a channel.
inline double distance(const std::array<double, 3>& a, const std::array<float, 3>& b) {
  double largest = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    largest = std::max(largest, std::abs(a[c] - static_cast<double>(b[c])));
  }
  return largest;
}

/// How dark a column of pixels is against white, summed along a row: the width of a black line in
/// pixels; and where its middle is.
struct LineProfile {
  double width = 0;
  double centre = 0;
};
inline LineProfile profile_of_row(const Image& image, int y, int first, int last) {
  LineProfile profile;
  for (int x = first; x < last; ++x) {
    const double dark = 1.0 - image.pixel(x, y)[1] / 255.0;
    profile.width += dark;
    profile.centre += dark * (x + 0.5);
  }
  if (profile.width > 0) profile.centre /= profile.width;
  return profile;
}

/// Space drawn into an off-screen picture on white; seen from -y, x to the right, z up, [-1, 1] by
/// [-1, 1] unless the test looks elsewhere.
class SpaceSceneRig {
 public:
  explicit SpaceSceneRig(int side = 200)
      : context_(make_headless_context()), target_(side, side, 4), side_(side) {
    camera.set_viewport(0, 0, side, side);
    camera.look_from({-90, 0});
    camera.look_at(Vec3::Zero(), 2.0 / side);
  }

  Image draw(const SpaceScene& scene) {
    renderer_.set_scene(scene);
    target_.clear({1, 1, 1, 1});
    renderer_.draw(camera, side_);
    return target_.read();
  }
  /// Red, green and blue where a point is seen.
  std::array<double, 3> color(const Image& image, const Vec3& point) const {
    return color_at(image, camera.project(point).at);
  }

 private:
  std::unique_ptr<HeadlessContext> context_;
  FrameBuffer target_;
  SpaceRenderer renderer_;
  int side_;

 public:
  SpaceCamera camera;
};

}  // namespace winslow::gui::test
