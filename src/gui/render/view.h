#pragma once

#include "core/mesh/coordinates.h"
#include "core/mesh/mesh.h"
#include "core/search/box_tree.h"
#include "gui/base/screen.h"

namespace winslow::gui {

/// A point of the plane z = 0.
inline Vec3 place_in_plane(const Vec2& point) { return {point.x(), point.y(), 0}; }

/// The direction from which space is seen. With the z axis up: at azimuth 0 and elevation 0 the
/// viewer is on the x axis, at azimuth 90 on the y axis, at elevation 90 above. With another axis
/// up, the two axes that follow it cyclically replace x and y: z and x if y is up.
struct ViewDirection {
  double azimuth = 0, elevation = 0;  ///< degrees
  int up = 2;                         ///< 0, 1, 2: the x, y or z axis is up on screen
  double roll = 0;  ///< degrees by which the picture is turned anticlockwise about the direction

  bool operator==(const ViewDirection&) const = default;
};

/// What a view looks at, and from which direction.
struct LookedAt {
  Vec3 centre{0, 0, 0};  ///< in the middle of the viewport
  double units_per_pixel = 1;
  std::optional<ViewDirection> direction;  ///< none: the plane, from above

  bool operator==(const LookedAt&) const = default;
};

/// Interface of the cameras: maps points of the mesh to the screen, and changes as the mouse
/// demands. Overlays and pickers use cameras only through it. Points have three coordinates, z = 0
/// in the plane.
///
///     const ScreenPoint at = view.project(point).at;
///     view.zoom_about(point, 2);  // the point stays there
class View {
 public:
  virtual ~View() = default;

  struct Projection {
    ScreenPoint at;
    double depth = 0;  ///< away from the viewer, in units of the mesh
  };
  virtual Projection project(const Vec3& point) const = 0;
  /// The ray of all points seen at a place of the screen, from the viewer on.
  virtual Ray<3> unproject(const ScreenPoint& at) const = 0;
  /// Width of a pixel at a point, in units of the mesh.
  virtual double pixel_size(const Vec3& point) const = 0;
  /// The part of the screen that shows the mesh.
  virtual ScreenBox viewport() const = 0;
  /// The part of the plane z = 0 that is seen.
  virtual Bounds visible() const = 0;

  /// The point at a place of the screen with the depth of another point; for the plane, the point
  /// of the plane there.
  virtual Vec3 at_depth_of(const Vec3& point, const ScreenPoint& at) const = 0;

  virtual LookedAt looked_at() const = 0;
  /// Restores a view.
  virtual void look_at(const LookedAt& place) = 0;
  /// Pans so that what lies at a point moves with the mouse.
  virtual void pan_at(const Vec3& point, const ScreenVector& by) = 0;
  /// factor > 1 zooms in; a point stays where it is on screen.
  virtual void zoom_about(const Vec3& point, double factor) = 0;
  /// True if the mouse can turn the view: a drag that starts on nothing movable then turns it; else
  /// it pans.
  virtual bool turns() const { return false; }
  /// Turns about a point, which stays where it is on screen. freely: about the axes of the screen,
  /// so that the view may end up on its side; else as a turntable.
  virtual void turn(const Vec3& /*point*/, const ScreenVector& /*by*/, bool /*freely*/) {}

  // For points of the plane z = 0.
  ScreenPoint to_screen(const Vec2& point) const { return project({point.x(), point.y(), 0}).at; }
  /// Intersection of the ray through a place with the plane.
  Vec2 to_plane(const ScreenPoint& at) const;
  double pixel_size(const Vec2& point) const { return pixel_size(Vec3(point.x(), point.y(), 0)); }
};

/// Equal for views that show everything at the same places of the screen.
struct ViewKey {
  LookedAt looked_at;
  ScreenBox viewport;
  Vec3 origin{0, 0, 0}, direction{0, 0, 0};  ///< of the ray through a corner

  ViewKey() = default;
  explicit ViewKey(const View& view);
  bool operator==(const ViewKey&) const = default;
};

/// Camera for the plane, seen from above.
class Camera final : public View {
 public:
  void set_viewport(double x, double y, double width, double height);
  double viewport_width() const { return width_; }
  double viewport_height() const { return height_; }
  ScreenPoint viewport_origin() const { return {x_, y_}; }
  ScreenBox viewport() const override { return {{x_, y_}, {x_ + width_, y_ + height_}}; }

  Vec2 centre() const { return centre_; }
  double units_per_pixel() const { return units_per_pixel_; }
  /// Ignored if not finite or not positive. The zoom stops where neighbouring pixels would be the
  /// same double.
  void look_at(const Vec2& centre, double units_per_pixel);

  Vec2 to_world(const ScreenPoint& screen) const;
  ScreenPoint to_screen(const Vec2& world) const;

  void pan(const ScreenVector& by);
  /// factor > 1 zooms in; the point under `screen` stays there.
  void zoom_at(const ScreenPoint& screen, double factor);
  /// Shows a box whole, with a margin (share of the viewport).
  void fit(const Bounds& box, double margin = 0.05);
  Bounds visible() const override;

  /// Column-major 4x4 matrix to clip space of the viewport, from positions relative to `origin`.
  /// The origin is subtracted in double precision before positions become floats, so that a zoom of
  /// 1e6 shows no round-off of single precision. Points above the plane (z > 0) are nearer, at the
  /// scale of x.
  std::array<float, 16> matrix(const Vec3& origin) const;

  using View::pixel_size;
  Projection project(const Vec3& point) const override;
  Ray<3> unproject(const ScreenPoint& at) const override;
  double pixel_size(const Vec3& /*point*/) const override { return units_per_pixel_; }
  Vec3 at_depth_of(const Vec3& point, const ScreenPoint& at) const override;
  LookedAt looked_at() const override;
  void look_at(const LookedAt& place) override;
  void pan_at(const Vec3& /*point*/, const ScreenVector& by) override { pan(by); }
  void zoom_about(const Vec3& point, double factor) override;

  bool operator==(const Camera& other) const {
    return viewport() == other.viewport() && centre_ == other.centre_ &&
           units_per_pixel_ == other.units_per_pixel_;
  }

 private:
  double x_ = 0, y_ = 0, width_ = 1, height_ = 1;
  Vec2 centre_{0, 0};
  double units_per_pixel_ = 1;
};

/// The camera for a part of the framebuffer, with the part's corner as (0, 0). Its viewport is
/// clipped to whole pixels, as the renderer draws them. None if viewport and part do not overlap.
std::optional<Camera> part_of(const Camera& camera, const ScreenBox& part);

}  // namespace winslow::gui
