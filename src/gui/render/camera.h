#pragma once

#include <array>
#include <optional>

#include "core/mesh/mesh.h"
#include "gui/base/screen.h"

namespace winslow::gui {

/// What part of the plane is seen, and where on screen.
class Camera {
 public:
  void set_viewport(double x, double y, double width, double height);
  double viewport_width() const { return width_; }
  double viewport_height() const { return height_; }
  ScreenPoint viewport_origin() const { return {x_, y_}; }
  ScreenBox viewport() const { return {{x_, y_}, {x_ + width_, y_ + height_}}; }

  Vec2 centre() const { return centre_; }
  double units_per_pixel() const { return units_per_pixel_; }
  /// Ignored if not finite or not positive. Stops where neighbouring pixels would be one double.
  void look_at(const Vec2& centre, double units_per_pixel);

  Vec2 to_world(const ScreenPoint& screen) const;
  ScreenPoint to_screen(const Vec2& world) const;

  void pan(const ScreenVector& by);
  /// factor > 1 zooms in; the point under `screen` stays there.
  void zoom_at(const ScreenPoint& screen, double factor);
  /// Shows a box whole, with a margin (share of the viewport).
  void fit(const Bounds& box, double margin = 0.05);
  Bounds visible() const;

  /// Column-major 4x4 matrix to clip space of the viewport, from positions relative to `origin`.
  /// The origin is subtracted in double precision before positions become floats, so that a zoom of
  /// 1e6 shows no round-off of single precision. What lies above the plane (z > 0) comes nearer, by
  /// the scale of x.
  std::array<float, 16> matrix(const Vec3& origin) const;

  bool operator==(const Camera&) const = default;

 private:
  double x_ = 0, y_ = 0, width_ = 1, height_ = 1;
  Vec2 centre_{0, 0};
  double units_per_pixel_ = 1;
};

/// What a camera sees of a part of the framebuffer, with the part's corner as (0, 0): its
/// viewport is cut off to whole pixels, as the renderer draws them. None where the two do not meet.
std::optional<Camera> part_of(const Camera& camera, const ScreenBox& part);

}  // namespace winslow::gui
