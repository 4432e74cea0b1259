#pragma once

#include <memory>

#include "gui/render/frame_buffer.h"
#include "gui/render/gl_context.h"
#include "gui/render/space/space_renderer.h"
#include "gui/support/scene.h"

namespace winslow::gui::test {

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
