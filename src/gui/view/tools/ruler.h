#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "gui/document/session/session.h"
#include "gui/settings/view_state.h"
#include "gui/view/tools/viewport.h"

namespace winslow::gui {

/// The points of a ruler, set by clicks: two or three, of which those that snapped to nodes go with
/// them when the mesh moves. Point: has `at`, a place in the plane or in space, and `node`.
template <class Point>
class RulerPoints {
 public:
  /// Takes the mouse. under: where a click would put a point; none: nowhere.
  void take(const PointerState& pointer, std::optional<Point> under, double scale) {
    constexpr double slack = 4;  // pixels at scale 1; what goes farther moves the view
    const bool pressed = pointer.left && !was_down_;
    const bool released = !pointer.left && was_down_;
    was_down_ = pointer.left;
    hovered_ = std::move(under);
    if (pressed && pointer.over) press_ = pointer.position;
    if (!released || !press_) return;
    const bool click = (pointer.position - *press_).norm() <= slack * scale;
    press_.reset();
    if (!click || !hovered_) return;
    if (points_.size() == 3) points_.clear();
    points_.push_back(*hovered_);
  }
  /// Goes with the mesh.
  void follow(const Session& session) {
    const auto& topology = session.topology();
    // Another mesh, or other elements: the numbers of nodes mean others.
    if (topology_ != topology) {
      for (Point& point : points_) point.node.reset();
      topology_ = topology;
    }
    for (Point& point : points_)
      if (point.node) point.at = session.coordinates().get<dimension>(*point.node);
  }
  void clear() {
    points_.clear();
    hovered_.reset();
    press_.reset();
  }

  /// Clicked so far, three at most.
  const std::vector<Point>& clicked() const { return points_; }
  /// Those, and where the next click would put one.
  std::vector<Point> drawn() const {
    std::vector<Point> all = points_;
    if (hovered_ && all.size() < 3) all.push_back(*hovered_);
    return all;
  }

 private:
  static constexpr int dimension = decltype(Point::at)::RowsAtCompileTime;

  std::vector<Point> points_;
  std::optional<Point> hovered_;
  std::optional<ScreenPoint> press_;
  bool was_down_ = false;
  std::shared_ptr<const Topology> topology_;  // that the nodes are of
};

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
