#include "gui/view/tools/gizmo.h"

#include <Eigen/Geometry>

namespace winslow::gui {

namespace {

constexpr double end_on = 0.2;  // sine of a line, cosine of a plane's normal to the line of sight
constexpr double ring_edge_on = 0.25;  // cosine of a ring's axis to the viewer
constexpr double most_speed = 6;       // of a point, relative to that of the mouse
constexpr double smallest_circle =
    0.1;  // of a ring's radius: nearer to the centre there is no angle

/// Position on a line nearest to a ray.
double nearest_on_line(const Ray<3>& ray, const Vec3& point, const Vec3& direction) {
  const Vec3 along = ray.direction.normalized();
  const Vec3 between = point - ray.origin;
  const double cosine = direction.dot(along);
  return (cosine * between.dot(along) - between.dot(direction)) / (1 - cosine * cosine);
}

/// Intersection of a ray with a plane, in front of the viewer.
std::optional<Vec3> meet_plane(const Ray<3>& ray, const Vec3& point, const Vec3& normal) {
  const double t = normal.dot(point - ray.origin) / normal.dot(ray.direction);
  if (!std::isfinite(t) || t < 0) return std::nullopt;
  return ray.origin + t * ray.direction;
}

double longest(const View& view, const Vec3& point, const ScreenPoint& from,
               const ScreenPoint& to) {
  return most_speed * (to - from).norm() * view.pixel_size(point);
}

/// Angle on screen, clockwise, radians.
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

namespace {

using Kind = Handle::Kind;

// Framebuffer pixels at scale 1.
constexpr double shaft_begins = 12, arrow_ends = 66;
constexpr double square_near = 25, square_far = 43;
constexpr double ring_at = 86, screen_ring_at = 106;
constexpr double centre_reach = 9, arrow_reach = 7, ring_reach = 6.3, knob_reach = 9, pin_reach = 7;
constexpr double pin_away = 20;
// In the plane.
constexpr double shortest_arrow = 32, longest_arrow = 64;
constexpr double ring_gap = 26, smallest_ring = 52;
constexpr std::size_t ring_points = 96;
// Points less far behind the centre than this, in radii, count as in front, so that a ring that
// faces the viewer is all in front.
constexpr double just_behind = 0.12;
constexpr double least_arrow = 0.2;   // sine to the viewer of an arrow that can be grabbed
constexpr double least_square = 0.2;  // cosine to the viewer of the normal of a square

bool in_polygon(const ScreenPoint& p, const std::array<ScreenPoint, 4>& corners) {
  bool inside = false;
  for (std::size_t k = 0; k < corners.size(); ++k)
    if (right_of(p, corners[k], corners[(k + 1) % corners.size()])) inside = !inside;
  return inside;
}

double distance_to_ring(const ScreenPoint& p, const std::vector<Gizmo::RingPoint>& ring) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const auto &a = ring[k], &b = ring[(k + 1) % ring.size()];
    if (a.front && b.front) least = std::min(least, distance_to_segment(p, a.at, b.at));
  }
  return least;
}

std::vector<Gizmo::RingPoint> ring_about(const View& view, const Gizmo& g, int axis,
                                         double radius) {
  const Vec3 &u = g.frame().axes[at((axis + 1) % 3)], &v = g.frame().axes[at((axis + 2) % 3)];
  std::vector<Gizmo::RingPoint> ring;
  ring.reserve(ring_points);
  for (std::size_t k = 0; k < ring_points; ++k) {
    const double angle = 2 * pi * static_cast<double>(k) / ring_points;
    const Vec3 arm = std::cos(angle) * u + std::sin(angle) * v;
    ring.push_back(
        {view.project(g.place.pivot + radius * arm).at, arm.dot(g.viewer) >= -just_behind});
  }
  return ring;
}

double reach_of(Kind kind) {
  // In the order of Handle::Kind; a square is grabbed inside its outline.
  constexpr std::array<double, 7> reach{0,          centre_reach, arrow_reach, 0,
                                        ring_reach, ring_reach,   pin_reach};
  return reach[static_cast<std::size_t>(kind)];
}

/// Radius of the ring in the plane, pixels: large enough to grab when seen from afar, and within
/// the window when seen from near.
double ring_around(const View& view, const GizmoPlace& place, double scale) {
  const ScreenVector size = view.viewport().size();
  const double room = 0.42 * std::min(size.x(), size.y());
  return std::max(smallest_ring * scale,
                  std::min(place.reach / view.pixel_size(place.pivot) + ring_gap * scale, room));
}

/// The handles, by priority when they overlap.
std::vector<Handle> handles_of(const Gizmo& g) {
  std::vector<Handle> all{{Kind::centre, 0}};
  const bool flat = g.place.in_plane;
  const auto axis = [&](int k) -> const Vec3& { return g.frame().axes[at(k)]; };
  if (g.pin) all.push_back({Kind::pin, 0});
  for (int k = 0; k < 3 && !flat; ++k)
    if (std::abs(axis(k).dot(g.viewer)) > least_square) all.push_back({Kind::square, k});
  for (int k = 0; k < (flat ? 2 : 3); ++k)
    if (axis(k).cross(g.viewer).norm() > least_arrow) all.push_back({Kind::arrow, k});
  if (!g.place.turns) return all;
  for (int k = flat ? 2 : 0; k < 3; ++k) all.push_back({Kind::ring, k});
  if (!flat) all.push_back({Kind::screen_ring, 0});
  return all;
}

void place_arrow(Gizmo& g, const View& view, int k, double length) {
  const double unit = view.pixel_size(g.place.pivot);
  const Vec3& axis = g.frame().axes[at(k)];
  g.shafts[at(k)] = view.project(g.place.pivot + shaft_begins * g.scale * unit * axis).at;
  g.tips[at(k)] = view.project(g.place.pivot + length * unit * axis).at;
}

void place_square(Gizmo& g, const View& view, int k) {
  const double unit = g.scale * view.pixel_size(g.place.pivot);
  const Vec3& pivot = g.place.pivot;
  const Vec3 &u = g.frame().axes[at((k + 1) % 3)], &v = g.frame().axes[at((k + 2) % 3)];
  const double n = square_near * unit, f = square_far * unit;
  g.squares[at(k)] = {
      view.project(pivot + n * u + n * v).at, view.project(pivot + f * u + n * v).at,
      view.project(pivot + f * u + f * v).at, view.project(pivot + n * u + f * v).at};
}

}  // namespace

GizmoFrame GizmoFrame::about(const Vec3& axis, const char* name) {
  constexpr double parallel = 1e-9;
  GizmoFrame frame;
  const Vec3 w = axis.normalized();
  Index least = 0;
  if (1 - w.cwiseAbs().maxCoeff() < parallel) return frame;
  w.cwiseAbs().minCoeff(&least);
  const Vec3 u = (Vec3::Unit(least) - w[least] * w).normalized();
  frame.axes = {u, w.cross(u), w};
  frame.aligned = true;
  frame.third = name;
  return frame;
}

const char* GizmoFrame::name(int axis) const {
  constexpr std::array<const char*, 3> own{"x", "y", "z"}, across{"u", "v", ""};
  if (!aligned) return own[winslow::at(axis)];
  return axis == 2 ? third : across[winslow::at(axis)];
}

bool Gizmo::has(const Handle& handle) const {
  return std::ranges::find(handles, handle) != handles.end();
}

double Gizmo::distance(const Handle& handle, const ScreenPoint& p) const {
  const std::size_t k = winslow::at(handle.axis);
  switch (handle.kind) {
    case Kind::centre:
      return (p - centre).norm();
    case Kind::pin:
      return (p - *pin).norm();
    case Kind::square:
      if (in_polygon(p, squares[k])) return 0;
      break;
    case Kind::arrow:
      return distance_to_segment(p, shafts[k], tips[k]);
    case Kind::ring:
      return distance_to_ring(p, rings[k]);
    case Kind::screen_ring:
      return std::abs((p - centre).norm() - screen_radius);
    case Kind::none:
      break;
  }
  return std::numeric_limits<double>::infinity();
}

Handle Gizmo::handle_at(const ScreenPoint& p) const {
  if (knob && (p - *knob).norm() <= knob_reach * scale) return {Kind::ring, 2};
  Handle ring;
  double least = ring_reach * scale;
  for (const Handle& handle : handles) {
    if (ring && handle.kind != Kind::ring) break;
    const double away = distance(handle, p);
    if (away > reach_of(handle.kind) * scale) continue;
    if (handle.kind != Kind::ring) return handle;
    if (away > least) continue;
    least = away;
    ring = handle;
  }
  return ring;
}

std::optional<Gizmo> make_gizmo(const View& view, const GizmoPlace& place, double scale) {
  Gizmo g;
  g.place = place;
  g.scale = scale;
  const Vec3& pivot = place.pivot;
  const auto [origin, direction] = view.unproject(view.project(pivot).at);
  if (!((pivot - origin).dot(direction) > 0)) return std::nullopt;
  g.viewer = towards_viewer(view, pivot);
  g.centre = view.project(pivot).at;
  g.screen_radius = screen_ring_at * scale;
  g.ring_radius = place.in_plane ? ring_around(view, place, scale) : ring_at * scale;
  if (place.in_plane) {
    g.pin = g.centre + pin_away * scale * ScreenVector(-0.7071, 0.7071);
    g.knob = on_ring(view, pivot, Vec3::UnitZ(), Vec3::UnitX(), 45 + place.turned, g.ring_radius);
  }
  const double arrow = place.in_plane ? std::clamp(0.6 * g.ring_radius, shortest_arrow * scale,
                                                   longest_arrow * scale)
                                      : arrow_ends * scale;
  g.handles = handles_of(g);
  for (int k = 0; k < 3; ++k) {
    place_arrow(g, view, k, arrow);
    place_square(g, view, k);
    if (g.has({Kind::ring, k}))
      g.rings[at(k)] = ring_about(view, g, k, g.ring_radius * view.pixel_size(pivot));
  }
  return g;
}

ScreenPoint on_ring(const View& view, const Vec3& pivot, const Vec3& axis, const Vec3& from,
                    double angle, double radius) {
  const Vec3 arm = Eigen::AngleAxisd(radians(angle), axis) * from;
  return view.project(pivot + radius * view.pixel_size(pivot) * arm).at;
}

}  // namespace winslow::gui
