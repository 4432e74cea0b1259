#pragma once

#include "core/inspect/space/plane_section.h"
#include "core/search/box_tree.h"
#include "gui/base/screen.h"
#include "gui/render/space/volume_scene.h"
#include "gui/render/view.h"

namespace winslow::gui {

/// Unit vector towards the viewer.
Vec3 to_viewer(const ViewDirection& direction);
/// The direction for which a vector, of any length but 0, points to the viewer. From above or
/// below, x is to the right if z is up.
ViewDirection direction_towards(const Vec3& viewer, int up);
/// The direction of a camera whose screen has these axes, to the right and towards the viewer, of
/// length 1.
ViewDirection direction_of(const Vec3& right, const Vec3& back, int up);

/// Camera for meshes in space, parallel or in perspective. The mouse turns it freely, or as a
/// turntable on which the up axis stays upright.
class SpaceCamera final : public View {
 public:
  void set_viewport(double x, double y, double width, double height);
  ScreenBox viewport() const override { return {{x_, y_}, {x_ + width_, y_ + height_}}; }

  /// The point in the middle of the viewport stays there.
  void look_from(const ViewDirection& direction);
  const ViewDirection& direction() const { return direction_; }
  /// The pivot stays where it is on screen.
  void look_from(const ViewDirection& direction, const Vec3& pivot);
  /// Sets the vertical field of view, degrees below 180; 0: parallel. The size of what lies at the
  /// centre stays.
  void set_perspective(double angle) { angle_ = angle; }
  bool in_perspective() const { return angle_ > 0; }

  /// The point in the middle of the viewport, and the size of a pixel there.
  Vec3 centre() const { return centre_; }
  double units_per_pixel() const { return units_per_pixel_; }
  /// Ignored if not finite or not positive.
  void look_at(const Vec3& centre, double units_per_pixel);
  /// Shows all points, with a margin (share of the viewport) on each side.
  void fit(std::span<const Vec3> points, double margin = 0.05);
  /// Sets the box in which everything drawn lies: depths beyond it need not be resolved.
  void set_content(const Box<3>& content) { content_ = content; }

  /// Axes of the screen, of length 1: to the right, up, towards the viewer.
  const Vec3& right() const { return right_; }
  const Vec3& up() const { return up_; }
  const Vec3& back() const { return back_; }

  Projection project(const Vec3& point) const override;
  Ray<3> unproject(const ScreenPoint& at) const override;
  double pixel_size(const Vec3& point) const override;
  /// Empty: the plane z = 0 has no special meaning here.
  Bounds visible() const override { return Bounds::empty(); }

  Vec3 at_depth_of(const Vec3& point, const ScreenPoint& at) const override;
  LookedAt looked_at() const override;
  void look_at(const LookedAt& place) override;
  void pan_at(const Vec3& point, const ScreenVector& by) override;
  void zoom_about(const Vec3& point, double factor) override;
  bool turns() const override { return true; }
  /// Half a turn for as many pixels as the view is high.
  void turn(const Vec3& pivot, const ScreenVector& by, bool freely) override;

  /// Column-major 4x4 matrix to clip space of the viewport, from positions relative to `origin`,
  /// which is subtracted in double precision. w is 1 at the centre: the ratio of a point's distance
  /// from the viewer to the centre's, 1 everywhere where the view is parallel.
  std::array<float, 16> matrix(const Vec3& origin) const;
  /// Change of the depth, -1 (nearest) to 1 (furthest), over the size of a pixel towards the
  /// viewer: the first number, plus the second times the depth itself.
  std::array<double, 2> pixel_depth() const;
  bool operator==(const SpaceCamera& other) const {
    return viewport() == other.viewport() && looked_at() == other.looked_at() &&
           angle_ == other.angle_ && content_ == other.content_;
  }
  /// Position of the viewer, in perspective.
  Vec3 viewer() const { return centre_ + distance() * back_; }

 private:
  /// Distance of the viewer from the centre; infinite if the view is parallel.
  double distance() const;
  /// Range of what is drawn, as heights above the centre towards the viewer.
  std::array<double, 2> depth_range() const;
  /// Clip coordinate z as a function of the height above the centre: the first number times the
  /// height, plus the second.
  std::array<double, 2> depth_row() const;

  double x_ = 0, y_ = 0, width_ = 1, height_ = 1;
  ViewDirection direction_;
  Vec3 right_{0, 1, 0}, up_{0, 0, 1}, back_{1, 0, 0};
  Vec3 centre_{0, 0, 0};
  double units_per_pixel_ = 1;
  double angle_ = 0;
  Box<3> content_{Vec3::Constant(-1), Vec3::Constant(1)};
};

/// Directions to look from, and cuts to begin with.

/// "iso", "+x", "-x", ...: names of directions to look from.
const std::vector<std::string>& view_names();
/// The direction of a name. Throws UsageError, listing the names, for an unknown one.
ViewDirection named_view(const std::string& name, int up = 2);

/// The default direction: onto a cut from its front, or three quarters from ahead.
ViewDirection automatic_view(const std::vector<Plane>& cuts, int up = 2);
/// The default cut: through the middle of the bodies, at right angles to the axis that points to
/// the viewer most. None if nothing encloses bodies.
std::vector<Plane> automatic_cuts(const Mesh& mesh, const VolumeBoundary& boundary,
                                  const ViewDirection& view);

/// The eight corners of a box, for SpaceCamera::fit().
std::vector<Vec3> corners_of(const Box<3>& box);

/// The places of two meshes side by side in a view.
struct SideBySide {
  ScreenBox before, now;
};
/// divider: share of the width left of it, less than 1.
inline SideBySide side_by_side(const ScreenBox& whole, double divider) {
  const double middle = whole.min.x() + divider * whole.size().x();
  return {{whole.min, {middle, whole.max.y()}}, {{middle, whole.min.y()}, whole.max}};
}
/// The whole view, from the part of it that the mesh now has.
inline ScreenBox whole_of(const ScreenBox& now, double divider) {
  return {{now.max.x() - now.size().x() / (1 - divider), now.min.y()}, now.max};
}

}  // namespace winslow::gui
