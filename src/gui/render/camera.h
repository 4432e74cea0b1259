#pragma once

#include <array>

#include "core/mesh/mesh.h"

namespace winslow::gui {

/// What part of the plane is seen. Screen coordinates are pixels of the framebuffer, x to the
/// right, y down, (0, 0) the top left corner.
class Camera {
 public:
  void set_viewport(double x, double y, double width, double height);
  double viewport_width() const { return width_; }
  double viewport_height() const { return height_; }
  Vec2 viewport_origin() const { return {x_, y_}; }

  Vec2 centre() const { return centre_; }
  double units_per_pixel() const { return units_per_pixel_; }
  /// Ignored if not finite or not positive. Stops where neighbouring pixels would be one double.
  void look_at(const Vec2& centre, double units_per_pixel);

  Vec2 to_world(const Vec2& screen) const;
  Vec2 to_screen(const Vec2& world) const;

  void pan(const Vec2& screen_delta);
  /// factor > 1 zooms in; the point under `screen` stays there.
  void zoom_at(const Vec2& screen, double factor);
  /// Shows a box whole, with a margin (share of the viewport).
  void fit(const Bounds& box, double margin = 0.05);
  Bounds visible() const;

  /// Column-major 4x4 matrix to clip space of the viewport, from positions relative to `origin`.
  /// The origin is subtracted in double precision before positions become floats, so that a zoom of
  /// 1e6 shows no round-off of single precision.
  std::array<float, 16> matrix(const Vec2& origin) const;

  bool operator==(const Camera&) const = default;

 private:
  double x_ = 0, y_ = 0, width_ = 1, height_ = 1;
  Vec2 centre_{0, 0};
  double units_per_pixel_ = 1;
};

}  // namespace winslow::gui
