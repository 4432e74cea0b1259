#pragma once

#include <vector>

#include "core/inspect/nodal_view.h"
#include "core/vcv/vcv_edit.h"

namespace winslow::gui {

/// One edge of a VCV under the mouse: turning it changes the two angles beside it, their sum kept,
/// pulling it changes its length. All other edges stay.
class VcvDrag {
 public:
  enum class Constraint { none, angle_only, length_only };

  /// edge: number of the edge, below view.neighbours.size().
  VcvDrag(const NodalView& view, std::size_t edge);

  std::size_t edge() const { return edge_; }
  /// The VCV with the edge's end at a point of the VCV's plane (as it was at the start: edge 0 on
  /// the positive x axis) or as near to it as makes sense: angles of 5 to 175 degrees, lengths from
  /// a tenth of the mean to `longest`.
  VcvEdit to(const Vec2& point, Constraint constraint, double longest) const;
  /// Angle by which a VCV that to() gave is turned so that the edges which stay do not move.
  double turn(const VcvEdit& edit) const;

 private:
  VcvEdit start_;  // in full
  std::size_t edge_;
  double before_ = 0;  // direction of the edge before, radians
};

}  // namespace winslow::gui
