#pragma once

#include "gui/render/space/space_camera.h"

namespace winslow::gui {

/// Space, turned by the mouse as a turntable, on which the axis that is up stays upright, or
/// freely.
class SpaceView : public View {
 public:
  using View::pixel_size;
  Projection project(const Vec3& point) const override { return camera_.project(point); }
  Ray<3> unproject(const ScreenPoint& at) const override { return camera_.unproject(at); }
  double pixel_size(const Vec3& point) const override { return camera_.pixel_size(point); }
  ScreenBox viewport() const override { return camera_.viewport(); }
  /// Nothing of the plane z = 0 is meant here: empty.
  Bounds visible() const override { return Bounds::empty(); }
  /// What lies as deep as the middle of the view moves with the mouse.
  void pan(const ScreenVector& by) override;
  void zoom_at(const ScreenPoint& at, double factor) override;

  /// What lies at a point moves with the mouse.
  void pan_at(const Vec3& point, const ScreenVector& by);
  /// A point stays where it is on screen.
  void zoom_about(const Vec3& point, double factor);
  /// Turns about a point, which stays where it is on screen: half a turn for as many pixels as the
  /// view is high.
  void orbit(const Vec3& pivot, const ScreenVector& by);
  /// The same, freely: about the axes of the screen, so that the view may end up on its side.
  void tumble(const Vec3& pivot, const ScreenVector& by);
  /// Looks from elsewhere; a point stays where it is on screen.
  void look_from(const ViewDirection& direction, const Vec3& pivot);
  /// A point at a place, as deep as another point.
  Vec3 at_depth_of(const Vec3& point, const ScreenPoint& at) const;

  const SpaceCamera& camera() const { return camera_; }
  SpaceCamera& camera() { return camera_; }

 private:
  SpaceCamera camera_;
};

}  // namespace winslow::gui
