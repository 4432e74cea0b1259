#include "gui/view/tools/ruler.h"

#include <Eigen/Geometry>
#include <cmath>

#include "core/inspect/space/surface_measures.h"

namespace winslow::gui {

namespace {

constexpr double in_degrees = 180 / pi;

}  // namespace

void Ruler::update(const PointerState& pointer, std::optional<Index> snapped, double scale,
                   const Session& session, const View& view) {
  points_.follow(session);
  std::optional<Point> under;
  if (pointer.over)
    under = snapped ? Point{session.coordinates().xy(*snapped), snapped}
                    : Point{view.to_plane(pointer.position), std::nullopt};
  points_.take(pointer, under, scale);
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

void SpaceRuler::update(const PointerState& pointer, const std::optional<SeenPlace>& seen,
                        double scale, const Session& session) {
  points_.follow(session);
  std::optional<Point> under;
  if (pointer.over && seen) {
    under = Point{seen->point, std::nullopt, seen->normal};
    if (seen->node && !pointer.shift) {
      under->node = seen->node;
      under->at = session.coordinates().xyz(*seen->node);
    }
  }
  points_.take(pointer, under, scale);
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
