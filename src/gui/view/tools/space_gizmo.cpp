#include "gui/view/tools/space_gizmo.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "gui/view/tools/space_travel.h"

namespace winslow::gui {

namespace {

// Framebuffer pixels at scale 1.
constexpr double shaft_begins = 12, arrow_ends = 66;
constexpr double square_near = 25, square_far = 43;
constexpr double ring_at = 86, screen_ring_at = 106;
constexpr double centre_reach = 9, arrow_reach = 7, ring_reach = 6;
constexpr std::size_t ring_points = 96;
// What lies this far behind the centre, in radii, still counts as in front: a ring that faces the
// viewer does with all of itself.
constexpr double just_behind = 0.12;
constexpr double least_arrow = 0.2;   // sine to the viewer of an arrow that can be taken
constexpr double least_square = 0.2;  // cosine to the viewer of the normal of a square

double distance_to_line(const ScreenPoint& p, const ScreenPoint& a, const ScreenPoint& b) {
  const ScreenVector along = b - a;
  const double t = std::clamp((p - a).dot(along) / std::max(along.squared_norm(), 1e-30), 0.0, 1.0);
  return (p - a - t * along).norm();
}

bool in_polygon(const ScreenPoint& p, const std::array<ScreenPoint, 4>& corners) {
  bool inside = false;
  for (std::size_t k = 0, last = corners.size() - 1; k < corners.size(); last = k++) {
    const ScreenPoint &a = corners[k], &b = corners[last];
    if ((a.y() > p.y()) == (b.y() > p.y())) continue;
    if (p.x() < a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x())) inside = !inside;
  }
  return inside;
}

double distance_to_ring(const ScreenPoint& p, const std::vector<SpaceGizmo::RingPoint>& ring) {
  double least = 1e300;
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const auto &a = ring[k], &b = ring[(k + 1) % ring.size()];
    if (a.front && b.front) least = std::min(least, distance_to_line(p, a.at, b.at));
  }
  return least;
}

std::vector<SpaceGizmo::RingPoint> ring_about(const View& view, const SpaceGizmo& g, int axis,
                                              double radius) {
  const Vec3 &u = g.frame.axes[at((axis + 1) % 3)], &v = g.frame.axes[at((axis + 2) % 3)];
  std::vector<SpaceGizmo::RingPoint> ring;
  ring.reserve(ring_points);
  for (std::size_t k = 0; k < ring_points; ++k) {
    const double angle = 2 * pi * static_cast<double>(k) / ring_points;
    const Vec3 arm = std::cos(angle) * u + std::sin(angle) * v;
    ring.push_back({view.project(g.pivot + radius * arm).at, arm.dot(g.viewer) >= -just_behind});
  }
  return ring;
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

bool SpaceGizmo::takes_arrow(int axis) const {
  return frame.axes[winslow::at(axis)].cross(viewer).norm() > least_arrow;
}
bool SpaceGizmo::takes_square(int axis) const {
  return std::abs(frame.axes[winslow::at(axis)].dot(viewer)) > least_square;
}

SpaceHandle SpaceGizmo::at(const ScreenPoint& p) const {
  using Kind = SpaceHandle::Kind;
  if ((p - centre).norm() <= centre_reach * scale) return {Kind::centre, 0};
  for (int k = 0; k < 3; ++k)
    if (takes_square(k) && in_polygon(p, squares[winslow::at(k)])) return {Kind::square, k};
  for (int k = 0; k < 3; ++k)
    if (takes_arrow(k) &&
        distance_to_line(p, shafts[winslow::at(k)], tips[winslow::at(k)]) <= arrow_reach * scale)
      return {Kind::arrow, k};
  if (!turns) return {};
  SpaceHandle nearest;
  double least = ring_reach * scale;
  for (int k = 0; k < 3; ++k) {
    const double distance = distance_to_ring(p, rings[winslow::at(k)]);
    if (distance > least) continue;
    least = distance;
    nearest = {Kind::ring, k};
  }
  if (nearest) return nearest;
  if (std::abs((p - centre).norm() - screen_radius) <= ring_reach * scale)
    return {Kind::screen_ring, 0};
  return {};
}

std::optional<SpaceGizmo> make_space_gizmo(const View& view, const Vec3& pivot,
                                           const GizmoFrame& frame, bool turns, double scale) {
  SpaceGizmo g;
  g.pivot = pivot;
  g.frame = frame;
  g.turns = turns;
  g.scale = scale;
  const auto [origin, direction] = view.unproject(view.project(pivot).at);
  if (!((pivot - origin).dot(direction) > 0)) return std::nullopt;
  g.viewer = towards_viewer(view, pivot);
  g.centre = view.project(pivot).at;
  const double unit = scale * view.pixel_size(pivot);
  g.ring_radius = ring_at * scale;
  g.screen_radius = screen_ring_at * scale;
  for (int k = 0; k < 3; ++k) {
    const Vec3& axis = frame.axes[at(k)];
    const Vec3 &u = frame.axes[at((k + 1) % 3)], &v = frame.axes[at((k + 2) % 3)];
    g.shafts[at(k)] = view.project(pivot + shaft_begins * unit * axis).at;
    g.tips[at(k)] = view.project(pivot + arrow_ends * unit * axis).at;
    const double n = square_near * unit, f = square_far * unit;
    g.squares[at(k)] = {
        view.project(pivot + n * u + n * v).at, view.project(pivot + f * u + n * v).at,
        view.project(pivot + f * u + f * v).at, view.project(pivot + n * u + f * v).at};
    if (turns) g.rings[at(k)] = ring_about(view, g, k, ring_at * unit);
  }
  return g;
}

ScreenPoint on_ring(const View& view, const Vec3& pivot, const Vec3& axis, const Vec3& from,
                    double angle, double radius) {
  const Vec3 arm = Eigen::AngleAxisd(radians(angle), axis) * from;
  return view.project(pivot + radius * view.pixel_size(pivot) * arm).at;
}

}  // namespace winslow::gui
