#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "gui/document/session/session.h"
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

}  // namespace winslow::gui
