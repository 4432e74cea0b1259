#include "gui/view/tools/space_ruler.h"

#include <Eigen/Geometry>
#include <cmath>

#include "core/inspect/space/surface_measures.h"

namespace winslow::gui {

namespace {

constexpr double measuring_slack = 4;  // pixels at scale 1; what goes farther turns the view

}  // namespace

void SpaceRuler::clear() {
  points_.clear();
  hovered_.reset();
  press_.reset();
}

void SpaceRuler::follow(const Session& session) {
  const auto& topology = session.topology();
  // Another mesh, or other elements: the numbers of nodes mean others.
  if (topology_ != topology) {
    for (Point& point : points_) point.node.reset();
    topology_ = topology;
  }
  for (Point& point : points_)
    if (point.node) point.at = session.coordinates().xyz(*point.node);
}

void SpaceRuler::update(const PointerState& pointer, const std::optional<SeenPlace>& seen,
                        double scale, const Session& session) {
  const bool pressed = pointer.left && !was_down_;
  const bool released = !pointer.left && was_down_;
  was_down_ = pointer.left;
  follow(session);
  hovered_.reset();
  if (pointer.over && seen) {
    hovered_ = Point{seen->point, std::nullopt, seen->normal};
    if (seen->node && !pointer.shift) {
      hovered_->node = seen->node;
      hovered_->at = session.coordinates().xyz(*seen->node);
    }
  }
  if (pressed && pointer.over) press_ = pointer.position;
  if (!released || !press_) return;
  const bool click = (pointer.position - *press_).norm() <= measuring_slack * scale;
  press_.reset();
  if (!click || !hovered_) return;
  if (points_.size() == 3) points_.clear();
  points_.push_back(*hovered_);
}

std::vector<SpaceRuler::Point> SpaceRuler::drawn() const {
  std::vector<Point> all = points_;
  if (hovered_ && all.size() < 3) all.push_back(*hovered_);
  return all;
}

std::optional<SpaceMeasurement> measure(const std::vector<SpaceRuler::Point>& points) {
  if (points.size() < 2) return std::nullopt;
  SpaceMeasurement m;
  m.along = points[1].at - points[0].at;
  m.length = m.along.norm();
  if (points[0].normal && points[1].normal)
    m.faces = angle_between(*points[0].normal, *points[1].normal);
  if (points.size() < 3) return m;
  const Vec3 back = -m.along;
  const Vec3 on = points[2].at - points[1].at;
  m.second = on.norm();
  if (m.length > 0 && *m.second > 0)
    m.angle = degrees(std::atan2(back.cross(on).norm(), back.dot(on)));
  return m;
}

}  // namespace winslow::gui
