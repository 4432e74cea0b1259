#pragma once

#include "core/inspect/nodal_view.h"
#include "core/vcv/vcv_edit.h"

namespace winslow::gui {

/// Drags one edge of a VCV with the mouse. Turning it changes the two adjacent angles at a constant
/// sum; pulling it changes its length. All other edges stay.
class VcvDrag {
 public:
  enum class Constraint { none, angle_only, length_only };

  /// edge: number of the edge, below view.neighbours.size().
  VcvDrag(const NodalView& view, std::size_t edge);

  std::size_t edge() const { return edge_; }
  /// The VCV with the edge's end at a point of the VCV's plane, in the frame of the start (edge 0
  /// on the positive x axis). The end is limited to angles of 5 to 175 degrees and to lengths from
  /// a tenth of the mean to `longest`.
  VcvEdit to(const Vec2& point, Constraint constraint, double longest) const;
  /// Angle by which to turn the result of to() so that the other edges do not move.
  double turn(const VcvEdit& edit) const;

 private:
  VcvEdit start_;  // in full
  std::size_t edge_;
  double before_ = 0;  // direction of the edge before, radians
};

/// Drags one point of a VCV on the sphere with the mouse, or changes the length of its edge. All
/// other points stay. The point stops before a triangle of the link would turn over.
class SphereDrag {
 public:
  /// edge: number of the edge, below view.neighbours.size(). Directions are those of view.vcv.
  SphereDrag(const VolumeNodalView& view, std::size_t edge);

  std::size_t edge() const { return edge_; }
  /// Moves the point towards a direction, of any length but zero.
  void turn_to(const Vec3& direction);
  /// Sets the length of the edge, limited to a tenth of the mean and to `longest`.
  void stretch_to(double length, double longest);

  /// The VCV as it is now.
  VcvEdit edit() const;
  std::vector<Vec3> points() const;
  /// Triangle of the link that would have turned over at the last step, if one stopped it.
  const std::optional<Index>& stopped_by() const { return stopped_by_; }

 private:
  /// The triangle that turns over if the edge has this direction; none: the VCV is valid.
  std::optional<Index> turned_over(const Vec3& direction) const;

  SphereLink link_;
  Index node_;
  std::vector<Index> neighbours_;
  SphereStencil stencil_;
  std::size_t edge_;
  double least_ = 0;  // least solid angle of a triangle, as a share of the equal solid angle
  double shortest_ = 0;
  std::optional<Index> stopped_by_;
};

}  // namespace winslow::gui
