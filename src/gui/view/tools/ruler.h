#pragma once

#include "gui/document/session/session.h"
#include "gui/view/tools/pointer.h"

namespace winslow::gui {

/// A point of the ruler.
struct RulerPoint {
  Vec3 at{0, 0, 0};            ///< z = 0 in the plane
  std::optional<Index> node;   ///< that it snapped to
  std::optional<Vec3> normal;  ///< of the surface there, of length 1; none in the plane
};

/// Measures by clicks: two give a distance, in space with the angle between the two faces, a third
/// the angle at the second point. Points that snapped to nodes go with them when the mesh moves.
class Ruler {
 public:
  /// Takes the mouse. under: where a click puts a point; none: nowhere.
  void update(const PointerState& pointer, const std::optional<RulerPoint>& under, double scale,
              const Session& session);
  /// Takes all points away.
  void clear();

  /// Clicked so far, three at most.
  const std::vector<RulerPoint>& points() const { return points_; }
  /// Those, and where the next click would put one.
  std::vector<RulerPoint> drawn() const;

 private:
  void update(const Session& session);

  std::vector<RulerPoint> points_;
  std::optional<RulerPoint> hovered_;
  std::optional<ScreenPoint> press_;
  bool was_down_ = false;
  std::shared_ptr<const Topology> topology_;  // that the nodes are of
};

/// What two or three points measure, in units of the mesh and in degrees.
struct Measurement {
  double length = 0;                ///< from the first to the second
  Vec3 along{0, 0, 0};              ///< the same as a vector
  std::optional<double> direction;  ///< in the plane: of that vector against x, -180 to 180
  std::optional<double> faces;      ///< between the planes of the faces at both, 0 to 90
  std::optional<double> second;     ///< from the second to the third
  std::optional<double> angle;      ///< at the second point, 0 to 180; none: a leg has no length
};
/// None of fewer than two points.
std::optional<Measurement> measure(const std::vector<RulerPoint>& points);

}  // namespace winslow::gui
