#pragma once

#include "gui/render/space/space_scene.h"
#include "gui/render/space/space_view.h"

namespace winslow::gui {

/// Draws a scene into the bound framebuffer with the bound GL context. The light comes from the
/// viewer's left shoulder, and falls on either side of a surface.
class SpaceRenderer {
 public:
  SpaceRenderer();
  ~SpaceRenderer();
  SpaceRenderer(const SpaceRenderer&) = delete;
  SpaceRenderer& operator=(const SpaceRenderer&) = delete;

  /// Sets a scene in parts, drawn in this order; parts already held are not uploaded again. planes:
  /// clip all parts, at most most_clip_planes; the planes of the parts are ignored.
  void set_parts(const std::vector<std::shared_ptr<const SpaceScene>>& parts,
                 const std::vector<Plane>& planes);
  void set_scene(const SpaceScene& scene);
  /// Sets the colours towards which the surfaces of markers are tinted, by their alpha (#markers;
  /// those left out are not). Border lines of markers with a tint are thick.
  void set_tints(std::vector<Rgba> tints);
  /// Clears the depth of the camera's viewport and draws there. The camera's content should be the
  /// scene's extent.
  void draw(const SpaceCamera& camera, int framebuffer_height);

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace winslow::gui
