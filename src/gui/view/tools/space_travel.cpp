#include "gui/view/tools/space_travel.h"

#include <Eigen/Geometry>

namespace winslow::gui {

namespace {

constexpr double end_on = 0.2;         // sine of a line to the viewer, cosine of a plane's normal
constexpr double ring_edge_on = 0.25;  // cosine of a ring's axis to the viewer
constexpr double most_speed = 6;       // of a point, over that of the mouse
constexpr double smallest_circle =
    0.1;  // of a ring's radius: nearer to the centre there is no angle

/// Where on a line the ray through a place comes nearest to it.
double nearest_on_line(const Ray<3>& ray, const Vec3& point, const Vec3& direction) {
  const Vec3 along = ray.direction.normalized();
  const Vec3 between = point - ray.origin;
  const double cosine = direction.dot(along);
  return (cosine * between.dot(along) - between.dot(direction)) / (1 - cosine * cosine);
}

/// Where the ray through a place meets a plane, before the viewer.
std::optional<Vec3> meet_plane(const Ray<3>& ray, const Vec3& point, const Vec3& normal) {
  const double t = normal.dot(point - ray.origin) / normal.dot(ray.direction);
  if (!std::isfinite(t) || t < 0) return std::nullopt;
  return ray.origin + t * ray.direction;
}

double longest(const View& view, const Vec3& point, const ScreenPoint& from,
               const ScreenPoint& to) {
  return most_speed * (to - from).norm() * view.pixel_size(point);
}

/// Clockwise on screen, radians.
double screen_angle(const ScreenPoint& centre, const ScreenPoint& at) {
  const ScreenVector arm = at - centre;
  return std::atan2(arm.y(), arm.x());
}

/// A vector at right angles to a direction, of length 1.
Vec3 any_across(const Vec3& direction) {
  Index least = 0;
  direction.cwiseAbs().minCoeff(&least);
  return direction.cross(Vec3::Unit(least)).normalized();
}

}  // namespace

Vec3 towards_viewer(const View& view, const Vec3& point) {
  return -view.unproject(view.project(point).at).direction.normalized();
}

double travel_along(const View& view, const Vec3& point, const Vec3& direction,
                    const ScreenPoint& from, const ScreenPoint& to) {
  const Vec3 viewer = towards_viewer(view, point);
  if (direction.cross(viewer).norm() < end_on) return -(to - from).y() * view.pixel_size(point);
  const double way = nearest_on_line(view.unproject(to), point, direction) -
                     nearest_on_line(view.unproject(from), point, direction);
  const double most = longest(view, point, from, to);
  return std::isfinite(way) ? std::clamp(way, -most, most) : 0;
}

Vec3 travel_in_plane(const View& view, const Vec3& point, const Vec3& normal,
                     const ScreenPoint& from, const ScreenPoint& to) {
  const Vec3 viewer = towards_viewer(view, point);
  const Vec3 picture = normal.cross(viewer);
  const auto a = meet_plane(view.unproject(from), point, normal);
  const auto b = meet_plane(view.unproject(to), point, normal);
  if (std::abs(normal.dot(viewer)) < end_on || !a || !b) {
    const Vec3 line = picture.norm() > 0 ? Vec3(picture.normalized()) : any_across(normal);
    return travel_along(view, point, line, from, to) * line;
  }
  const Vec3 way = *b - *a;
  const double most = longest(view, point, from, to);
  return way.norm() > most ? Vec3(way * (most / way.norm())) : way;
}

double turn_about(const View& view, const Vec3& point, const Vec3& axis, double radius,
                  const ScreenPoint& from, const ScreenPoint& to) {
  const Vec3 viewer = towards_viewer(view, point);
  const double facing = axis.dot(viewer);
  const ScreenPoint centre = view.project(point).at;
  if (std::abs(facing) < ring_edge_on) {
    const Vec3 near = (viewer - facing * axis).normalized();
    const double unit = view.pixel_size(point);
    const ScreenVector tangent = view.project(point + unit * axis.cross(near)).at - centre;
    if (!(tangent.norm() > 0)) return 0;
    return degrees((to - from).dot(tangent) / (tangent.norm() * radius));
  }
  const double least = smallest_circle * radius;
  if ((from - centre).norm() < least || (to - centre).norm() < least) return 0;
  const auto a = meet_plane(view.unproject(from), point, axis);
  const auto b = meet_plane(view.unproject(to), point, axis);
  if (!a || !b) {
    const double by = std::remainder(screen_angle(centre, to) - screen_angle(centre, from), 2 * pi);
    return degrees(facing > 0 ? -by : by);
  }
  const Vec3 arm = *a - point, other = *b - point;
  return degrees(std::atan2(axis.dot(arm.cross(other)), arm.dot(other)));
}

}  // namespace winslow::gui
