#include "gui/view/tools/ruler.h"

#include "core/inspect/space/surface_measures.h"

namespace winslow::gui {

void Ruler::update(const PointerState& pointer, const std::optional<RulerPoint>& under,
                   double scale, const Session& session) {
  update(session);
  const bool pressed = pointer.left && !was_down_;
  const bool released = !pointer.left && was_down_;
  was_down_ = pointer.left;
  hovered_ = under;
  if (pressed && pointer.over) press_ = pointer.position;
  if (!released || !press_) return;
  // A longer movement is a drag of the view.
  const bool click = (pointer.position - *press_).norm() <= drag_threshold * scale;
  press_.reset();
  if (!click || !hovered_) return;
  if (points_.size() == 3) points_.clear();
  points_.push_back(*hovered_);
}

/// Moves points on nodes with the mesh.
void Ruler::update(const Session& session) {
  const auto& topology = session.topology();
  // Another mesh, or other elements: the numbers of nodes have another meaning.
  if (topology_ != topology) {
    for (RulerPoint& point : points_) point.node.reset();
    topology_ = topology;
  }
  for (RulerPoint& point : points_)
    if (point.node) point.at = place_of(session.coordinates(), *point.node);
}

void Ruler::clear() {
  points_.clear();
  hovered_.reset();
  press_.reset();
}

std::vector<RulerPoint> Ruler::drawn() const {
  std::vector<RulerPoint> all = points_;
  if (hovered_ && all.size() < 3) all.push_back(*hovered_);
  return all;
}

std::optional<Measurement> measure(const std::vector<RulerPoint>& points) {
  if (points.size() < 2) return std::nullopt;
  Measurement m;
  m.along = points[1].at - points[0].at;
  m.length = m.along.norm();
  if (points[0].normal && points[1].normal)
    m.faces = angle_between(*points[0].normal, *points[1].normal);
  else
    m.direction = degrees(std::atan2(m.along.y(), m.along.x()));
  if (points.size() < 3) return m;
  const Vec3 back = -m.along;
  const Vec3 on = points[2].at - points[1].at;
  m.second = on.norm();
  if (m.length > 0 && *m.second > 0)
    m.angle = degrees(std::atan2(back.cross(on).norm(), back.dot(on)));
  return m;
}

}  // namespace winslow::gui
