#pragma once

#include <optional>
#include <vector>

#include "gui/document/session/session.h"
#include "gui/view/tools/ruler_points.h"
#include "gui/view/tools/viewport.h"

namespace winslow::gui {

/// Measures by clicks: two give a distance, a third the angle at the second. Points that snapped to
/// nodes go with them when the mesh moves.
class Ruler {
 public:
  struct Point {
    Vec2 at{0, 0};
    std::optional<Index> node;  ///< that it snapped to
  };
  /// Takes the mouse. snapped: the node under it; none: the point itself.
  void update(const PointerState& pointer, std::optional<Index> snapped, double scale,
              const Session& session, const View& view);
  /// Takes all points away.
  void clear() { points_.clear(); }

  /// Clicked so far, three at most.
  const std::vector<Point>& points() const { return points_.clicked(); }
  /// Those, and where the next click would put one.
  std::vector<Point> drawn() const { return points_.drawn(); }

 private:
  RulerPoints<Point> points_;
};

/// What two or three points measure, in units of the mesh and in degrees.
struct Measurement {
  double length = 0;             ///< from the first to the second
  Vec2 along{0, 0};              ///< the same as a vector
  double direction = 0;          ///< of that vector against x, -180 to 180
  std::optional<double> second;  ///< from the second to the third
  std::optional<double> angle;   ///< at the second point, 0 to 180; none: a leg has no length
};
/// None of fewer than two points.
std::optional<Measurement> measure(const std::vector<Ruler::Point>& points);

}  // namespace winslow::gui
