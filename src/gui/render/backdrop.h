#pragma once

#include "gui/render/camera.h"
#include "gui/render/mesh_renderer.h"

namespace winslow::gui {

/// What lies behind a mesh: one colour, or two that run into each other.
struct BackdropColors {
  Rgba top{1, 1, 1, 1}, bottom{1, 1, 1, 1};
  /// Lines on it must be light.
  bool dark() const;
  bool operator==(const BackdropColors&) const = default;
};

/// Fills the camera's part of the bound framebuffer, `framebuffer_height` pixels high. whole: the
/// view that the camera sees a part of, over all of which the colours run.
void draw_backdrop(const Camera& camera, const Camera& whole, const BackdropColors& colors,
                   int framebuffer_height);

}  // namespace winslow::gui
