#pragma once

#include "core/mesh/mesh.h"
#include "core/search/box_tree.h"
#include "gui/base/screen.h"
#include "gui/render/camera.h"

namespace winslow::gui {

/// How a mesh is seen: which point lies where on screen. What is drawn over a mesh, and what picks
/// in it, knows no more of cameras than this; points are of three numbers, z = 0 in the plane.
class View {
 public:
  virtual ~View() = default;

  struct Projection {
    ScreenPoint at;
    double depth = 0;  ///< away from the viewer, in units of the mesh
  };
  virtual Projection project(const Vec3& point) const = 0;
  /// All points that are seen at a place, the nearest to the viewer first.
  virtual Ray<3> unproject(const ScreenPoint& at) const = 0;
  /// What a pixel is wide at a point, in units of the mesh.
  virtual double pixel_size(const Vec3& point) const = 0;
  /// The part of the screen that shows the mesh.
  virtual ScreenBox viewport() const = 0;
  /// The part of the plane z = 0 that is seen.
  virtual Bounds visible() const = 0;

  /// By the mouse: what is seen moves with it.
  virtual void pan(const ScreenVector& by) = 0;
  /// factor > 1 zooms in; what is seen at a place stays there.
  virtual void zoom_at(const ScreenPoint& at, double factor) = 0;

  // Of points of the plane z = 0.
  ScreenPoint to_screen(const Vec2& point) const { return project({point.x(), point.y(), 0}).at; }
  /// Where the ray through a place meets the plane.
  Vec2 to_plane(const ScreenPoint& at) const;
  double pixel_size(const Vec2& point) const { return pixel_size(Vec3(point.x(), point.y(), 0)); }
};

/// The plane, seen from above.
class PlaneView : public View {
 public:
  PlaneView() = default;
  explicit PlaneView(const Camera& camera) : camera_(camera) {}

  using View::pixel_size;
  Projection project(const Vec3& point) const override;
  Ray<3> unproject(const ScreenPoint& at) const override;
  double pixel_size(const Vec3& /*point*/) const override { return camera_.units_per_pixel(); }
  ScreenBox viewport() const override { return camera_.viewport(); }
  Bounds visible() const override { return camera_.visible(); }
  void pan(const ScreenVector& by) override { camera_.pan(by); }
  void zoom_at(const ScreenPoint& at, double factor) override { camera_.zoom_at(at, factor); }

  const Camera& camera() const { return camera_; }
  Camera& camera() { return camera_; }

 private:
  Camera camera_;
};

}  // namespace winslow::gui
