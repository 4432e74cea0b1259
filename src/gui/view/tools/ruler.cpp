#include "gui/view/tools/ruler.h"

#include <algorithm>
#include <cmath>

namespace winslow::gui {

namespace {

constexpr double ruler_slack = 4;  // pixels at scale 1; what goes farther pans

constexpr double in_degrees = 180 / pi;

}  // namespace

void Ruler::clear() {
  points_.clear();
  hovered_.reset();
  press_.reset();
}

void Ruler::follow(const Session& session) {
  const auto& topology = session.topology();
  // Another mesh, or other elements: the numbers of nodes mean others.
  if (topology_ != topology) {
    for (Point& point : points_) point.node.reset();
    topology_ = topology;
  }
  for (Point& point : points_)
    if (point.node) point.at = session.coordinates().xy(*point.node);
}

void Ruler::update(const PointerState& pointer, std::optional<Index> snapped, double scale,
                   const Session& session, const View& view) {
  const bool pressed = pointer.left && !was_down_;
  const bool released = !pointer.left && was_down_;
  was_down_ = pointer.left;
  follow(session);
  hovered_.reset();
  if (pointer.over)
    hovered_ = snapped ? Point{session.coordinates().xy(*snapped), snapped}
                       : Point{view.to_plane(pointer.position), std::nullopt};
  if (pressed && pointer.over) press_ = pointer.position;
  if (!released || !press_) return;
  const bool click = (pointer.position - *press_).norm() <= ruler_slack * scale;
  press_.reset();
  if (!click || !hovered_) return;
  if (points_.size() == 3) points_.clear();
  points_.push_back(*hovered_);
}

std::vector<Ruler::Point> Ruler::drawn() const {
  std::vector<Point> all = points_;
  if (hovered_ && all.size() < 3) all.push_back(*hovered_);
  return all;
}

std::optional<Measurement> measure(const std::vector<Ruler::Point>& points) {
  if (points.size() < 2) return std::nullopt;
  Measurement m;
  m.along = points[1].at - points[0].at;
  m.length = m.along.norm();
  m.direction = std::atan2(m.along.y(), m.along.x()) * in_degrees;
  if (points.size() < 3) return m;
  const Vec2 back = -m.along;
  const Vec2 on = points[2].at - points[1].at;
  m.second = on.norm();
  if (m.length > 0 && *m.second > 0)
    m.angle =
        std::abs(std::atan2(back.x() * on.y() - back.y() * on.x(), back.dot(on))) * in_degrees;
  return m;
}

}  // namespace winslow::gui
