#include "gui/view/tools/ruler.h"

#include <cmath>

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

}  // namespace winslow::gui
