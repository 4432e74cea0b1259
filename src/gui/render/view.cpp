#include "gui/render/view.h"

namespace winslow::gui {

Vec2 View::to_plane(const ScreenPoint& at) const {
  const auto [origin, direction] = unproject(at);
  const double t = -origin.z() / direction.z();
  return {origin.x() + t * direction.x(), origin.y() + t * direction.y()};
}

View::Projection PlaneView::project(const Vec3& point) const {
  return {camera_.to_screen({point.x(), point.y()}), -point.z()};
}

/// From above the plane: points of it lie before the viewer.
Ray<3> PlaneView::unproject(const ScreenPoint& at) const {
  const Vec2 point = camera_.to_world(at);
  return {{point.x(), point.y(), 1}, {0, 0, -1}};
}

}  // namespace winslow::gui
