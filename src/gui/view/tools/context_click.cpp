#include "gui/view/tools/context_click.h"

#include <algorithm>
#include <span>
#include <utility>

namespace winslow::gui {

namespace {

// Framebuffer pixels at scale 1.
constexpr double context_slack = 4;
constexpr double context_boundary_radius = 7;
constexpr double context_node_radius = 10;

bool encloses(std::span<const Index> corners, const Coordinates& x, const Vec2& point) {
  // The crossing rule, which asks nothing of how the element is turned.
  bool inside = false;
  for (std::size_t k = 0, last = corners.size() - 1; k < corners.size(); last = k++) {
    const Vec2 a = x.xy(corners[k]);
    const Vec2 b = x.xy(corners[last]);
    if ((a.y() > point.y()) == (b.y() > point.y())) continue;
    if (point.x() < a.x() + (b.x() - a.x()) * (point.y() - a.y()) / (b.y() - a.y()))
      inside = !inside;
  }
  return inside;
}

std::optional<Index> element_at(const Session& session, const Vec2& point) {
  const Topology& topology = *session.topology();
  for (Index e = 0; e < topology.element_count(); ++e)
    if (encloses(topology.element(e), session.coordinates(), point)) return e;
  return std::nullopt;
}

std::optional<Index> node_at(const Session& session, const Vec2& point, double radius) {
  const Topology& topology = *session.topology();
  std::optional<Index> best;
  double nearest = radius;
  for (Index i = 0; i < topology.node_count(); ++i) {
    const double distance = (session.coordinates().xy(i) - point).norm();
    if (distance > nearest || !topology.used(i)) continue;
    nearest = distance;
    best = i;
  }
  return best;
}

}  // namespace

PickedPlace pick_place(const Session& session, const View& view, const MarkerLooks& looks,
                       const ScreenPoint& at, double scale) {
  PickedPlace place;
  if (!session.document()) return place;
  const Vec2 point = view.to_plane(at);
  const double pixel = scale * view.pixel_size(point);
  place.point = point;
  place.node = node_at(session, point, context_node_radius * pixel);
  place.element = element_at(session, point);
  const auto hit = session.mesh().boundary()->pick(point, context_boundary_radius * pixel);
  if (!hit) return place;
  const auto& markers = session.topology()->markers();
  const auto hidden = [&](Index m) {
    return looks.of(markers[static_cast<std::size_t>(m)].name).hidden;
  };
  place.markers = hit->markers;
  if (std::ranges::all_of(place.markers, hidden)) place.markers.clear();
  return place;
}

std::optional<ScreenPoint> ContextClick::update(const PointerState& pointer, double scale) {
  const bool pressed = pointer.right && !was_down_;
  const bool released = !pointer.right && was_down_;
  was_down_ = pointer.right;
  // With Control the right button draws the box to zoom to.
  if (pressed && pointer.over && !pointer.control && !pointer.left) press_ = pointer.position;
  if (press_ && (pointer.position - *press_).norm() > context_slack * scale) press_.reset();
  if (pointer.left) press_.reset();
  if (!released) return std::nullopt;
  return std::exchange(press_, std::nullopt);
}

}  // namespace winslow::gui
