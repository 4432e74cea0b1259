#include "gui/render/view.h"

namespace winslow::gui {

Vec2 View::to_plane(const ScreenPoint& at) const {
  const auto [origin, direction] = unproject(at);
  const double t = -origin.z() / direction.z();
  return {origin.x() + t * direction.x(), origin.y() + t * direction.y()};
}

ViewKey::ViewKey(const View& view) : looked_at(view.looked_at()), viewport(view.viewport()) {
  const Ray<3> ray = view.unproject(viewport.min);
  origin = ray.origin;
  direction = ray.direction;
}

View::Projection Camera::project(const Vec3& point) const {
  return {to_screen({point.x(), point.y()}), -point.z()};
}

/// The ray starts above the plane, so that points of the plane lie in front of the viewer.
Ray<3> Camera::unproject(const ScreenPoint& at) const {
  const Vec2 point = to_world(at);
  return {{point.x(), point.y(), 1}, {0, 0, -1}};
}

Vec3 Camera::at_depth_of(const Vec3& /*point*/, const ScreenPoint& at) const {
  return place_in_plane(to_world(at));
}

LookedAt Camera::looked_at() const {
  return {place_in_plane(centre_), units_per_pixel_, std::nullopt};
}

void Camera::look_at(const LookedAt& place) {
  look_at(place.centre.head<2>(), place.units_per_pixel);
}

void Camera::zoom_about(const Vec3& point, double factor) {
  zoom_at(to_screen(point.head<2>()), factor);
}

void Camera::set_viewport(double x, double y, double width, double height) {
  x_ = x;
  y_ = y;
  width_ = std::max(width, 1.0);
  height_ = std::max(height, 1.0);
}

void Camera::look_at(const Vec2& centre, double units_per_pixel) {
  if (!centre.allFinite() || !std::isfinite(units_per_pixel) || units_per_pixel <= 0) return;
  centre_ = centre;
  // At a deeper zoom, neighbouring pixels would be the same double.
  const double closest =
      4 * std::numeric_limits<double>::epsilon() * std::max(centre.cwiseAbs().maxCoeff(), 1e-200);
  units_per_pixel_ = std::max(units_per_pixel, closest);
}

Vec2 Camera::to_world(const ScreenPoint& screen) const {
  return {centre_.x() + (screen.x() - x_ - 0.5 * width_) * units_per_pixel_,
          centre_.y() - (screen.y() - y_ - 0.5 * height_) * units_per_pixel_};
}

ScreenPoint Camera::to_screen(const Vec2& world) const {
  return {x_ + 0.5 * width_ + (world.x() - centre_.x()) / units_per_pixel_,
          y_ + 0.5 * height_ - (world.y() - centre_.y()) / units_per_pixel_};
}

void Camera::pan(const ScreenVector& by) {
  look_at(centre_ + Vec2(-by.x(), by.y()) * units_per_pixel_, units_per_pixel_);
}

void Camera::zoom_at(const ScreenPoint& screen, double factor) {
  if (!std::isfinite(factor) || factor <= 0) return;
  const Vec2 from_centre(screen.x() - x_ - 0.5 * width_, y_ + 0.5 * height_ - screen.y());
  const double before = units_per_pixel_;
  look_at(centre_, before / factor);
  look_at(centre_ + from_centre * (before - units_per_pixel_), units_per_pixel_);
}

void Camera::fit(const Bounds& box, double margin) {
  const double share = std::max(1.0 - 2.0 * margin, 0.01);
  const Vec2 size = box.size();
  double units = std::max(size.x() / (share * width_), size.y() / (share * height_));
  if (!(units > 0)) units = 1.0 / std::min(width_, height_);
  look_at(box.centre(), units);
}

Bounds Camera::visible() const {
  const Vec2 half = 0.5 * units_per_pixel_ * Vec2(width_, height_);
  return {centre_ - half, centre_ + half};
}

std::array<float, 16> Camera::matrix(const Vec3& origin) const {
  const double sx = 2.0 / (width_ * units_per_pixel_);
  const double sy = 2.0 / (height_ * units_per_pixel_);
  std::array<float, 16> m{};
  m[0] = static_cast<float>(sx);
  m[5] = static_cast<float>(sy);
  m[10] = static_cast<float>(-sx);
  m[12] = static_cast<float>((origin.x() - centre_.x()) * sx);
  m[13] = static_cast<float>((origin.y() - centre_.y()) * sy);
  m[14] = static_cast<float>(-origin.z() * sx);
  m[15] = 1;
  return m;
}

std::optional<Camera> part_of(const Camera& camera, const ScreenBox& part) {
  const double left = std::round(camera.viewport_origin().x());
  const double top = std::round(camera.viewport_origin().y());
  const double x0 = std::max(part.min.x(), left);
  const double y0 = std::max(part.min.y(), top);
  const double x1 = std::min(part.max.x(), left + std::round(camera.viewport_width()));
  const double y1 = std::min(part.max.y(), top + std::round(camera.viewport_height()));
  if (x1 <= x0 || y1 <= y0) return std::nullopt;
  Camera met;
  met.set_viewport(x0 - part.min.x(), y0 - part.min.y(), x1 - x0, y1 - y0);
  met.look_at(camera.to_world(midpoint({x0, y0}, {x1, y1})), camera.units_per_pixel());
  return met;
}

}  // namespace winslow::gui
