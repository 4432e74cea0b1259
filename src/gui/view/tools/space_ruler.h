#pragma once

#include <optional>
#include <vector>

#include "gui/document/session/session.h"
#include "gui/settings/view_state.h"
#include "gui/view/tools/ruler_points.h"
#include "gui/view/tools/viewport.h"

namespace winslow::gui {

/// The ruler of volume meshes: two clicks give a distance and the angle between the two faces, a
/// third the angle at the second point. Points that snapped to nodes go with them.
class SpaceRuler {
 public:
  struct Point {
    Vec3 at{0, 0, 0};
    std::optional<Index> node;   ///< that it snapped to
    std::optional<Vec3> normal;  ///< of the surface there, of length 1
  };
  /// Takes the mouse. seen: what is under it.
  void update(const PointerState& pointer, const std::optional<SeenPlace>& seen, double scale,
              const Session& session);
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
struct SpaceMeasurement {
  double length = 0;             ///< from the first to the second
  Vec3 along{0, 0, 0};           ///< the same as a vector
  std::optional<double> faces;   ///< between the planes of the faces at both, 0 to 90
  std::optional<double> second;  ///< from the second to the third
  std::optional<double> angle;   ///< at the second point, 0 to 180; none: a leg has no length
};
/// None of fewer than two points.
std::optional<SpaceMeasurement> measure(const std::vector<SpaceRuler::Point>& points);

}  // namespace winslow::gui
