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

/// Measures by clicks. Two points give a distance, in space also the angle between the two faces; a
/// third point gives the angle at the second. Points that snapped to nodes move with the mesh.
class Ruler {
 public:
  /// Handles the mouse in a frame. under: where a click puts a point; none: nowhere.
  void update(const PointerState& pointer, const std::optional<RulerPoint>& under, double scale,
              const Session& session);
  /// Removes all points.
  void clear();

  /// The points clicked so far, three at most.
  const std::vector<RulerPoint>& points() const { return points_; }
  /// points(), and the point that the next click would add.
  std::vector<RulerPoint> drawn() const;

 private:
  void update(const Session& session);

  std::vector<RulerPoint> points_;
  std::optional<RulerPoint> hovered_;
  std::optional<ScreenPoint> press_;
  bool was_down_ = false;
  std::shared_ptr<const Topology> topology_;  // of the mesh of the nodes
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
/// None for fewer than two points.
std::optional<Measurement> measure(const std::vector<RulerPoint>& points);

}  // namespace winslow::gui
