#pragma once

#include <memory>

#include "gui/render/space/space_camera.h"
#include "gui/render/space/space_scene.h"

namespace winslow::gui {

/// Draws a scene into the bound framebuffer with the bound GL context. The light comes from the
/// viewer's left shoulder, and falls on either side of a surface.
class SpaceRenderer {
 public:
  SpaceRenderer();
  ~SpaceRenderer();
  SpaceRenderer(const SpaceRenderer&) = delete;
  SpaceRenderer& operator=(const SpaceRenderer&) = delete;

  void set_scene(const SpaceScene& scene);
  /// Clears the depth of the camera's viewport and draws there. The camera's content should be the
  /// scene's extent.
  void draw(const SpaceCamera& camera, int framebuffer_height);

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace winslow::gui
