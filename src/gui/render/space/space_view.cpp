#include "gui/render/space/space_view.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace winslow::gui {

Vec3 SpaceView::at_depth_of(const Vec3& point, const ScreenPoint& at) const {
  const auto [origin, direction] = camera_.unproject(at);
  const double along = camera_.back().dot(direction);
  return origin + camera_.back().dot(point - origin) / along * direction;
}

void SpaceView::pan(const ScreenVector& by) { pan_at(camera_.centre(), by); }

void SpaceView::pan_at(const Vec3& point, const ScreenVector& by) {
  const double unit = camera_.pixel_size(point);
  camera_.look_at(camera_.centre() - unit * (by.x() * camera_.right() - by.y() * camera_.up()),
                  camera_.units_per_pixel());
}

void SpaceView::zoom_at(const ScreenPoint& at, double factor) {
  zoom_about(at_depth_of(camera_.centre(), at), factor);
}

/// All is seen as before from a viewer that is nearer to the point by the factor.
void SpaceView::zoom_about(const Vec3& point, double factor) {
  camera_.look_at(point + (camera_.centre() - point) / factor, camera_.units_per_pixel() / factor);
}

void SpaceView::look_from(const ViewDirection& direction, const Vec3& pivot) {
  const Vec3 from = camera_.centre() - pivot;
  const double right = camera_.right().dot(from), up = camera_.up().dot(from),
               back = camera_.back().dot(from);
  camera_.look_from(direction);
  camera_.look_at(pivot + right * camera_.right() + up * camera_.up() + back * camera_.back(),
                  camera_.units_per_pixel());
}

void SpaceView::orbit(const Vec3& pivot, const ScreenVector& by) {
  const double degrees_per_pixel = 180 / std::max(camera_.viewport().size().y(), 1.0);
  ViewDirection direction = camera_.direction();
  direction.roll = 0;
  direction.azimuth = std::remainder(direction.azimuth - degrees_per_pixel * by.x(), 360);
  direction.elevation = std::clamp(direction.elevation + degrees_per_pixel * by.y(), -90.0, 90.0);
  look_from(direction, pivot);
}

void SpaceView::tumble(const Vec3& pivot, const ScreenVector& by) {
  const double per_pixel = pi / std::max(camera_.viewport().size().y(), 1.0);
  // What is turned is the viewer, against the way that the mesh goes.
  const Eigen::Matrix3d turn = (Eigen::AngleAxisd(-per_pixel * by.x(), camera_.up()) *
                                Eigen::AngleAxisd(-per_pixel * by.y(), camera_.right()))
                                   .toRotationMatrix();
  look_from(direction_of(turn * camera_.right(), turn * camera_.back(), camera_.direction().up),
            pivot);
}

}  // namespace winslow::gui
