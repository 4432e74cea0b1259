#pragma once

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

/// One point of a VCV on the sphere under the mouse: it goes where it is taken, or its edge becomes
/// longer or shorter. All others stay. A triangle of the link that would turn over stops it at the
/// last place where none does.
class SphereDrag {
 public:
  /// edge: number of the edge, below view.neighbours.size(). Directions are those of view.vcv.
  SphereDrag(const VolumeNodalView& view, std::size_t edge);

  std::size_t edge() const { return edge_; }
  /// Towards a direction, of any length but zero.
  void turn_to(const Vec3& direction);
  /// To a length; from a tenth of the mean to `longest`.
  void stretch_to(double length, double longest);

  /// The VCV as it is now.
  VcvEdit edit() const;
  std::vector<Vec3> points() const;
  /// Triangle of the link that would have turned over at the last step, if one stopped it.
  const std::optional<Index>& stopped_by() const { return stopped_by_; }

 private:
  /// None if the VCV with the edge in this direction is valid; else what is not.
  std::optional<Index> turned_over(const Vec3& direction) const;

  SphereLink link_;
  Index node_;
  std::vector<Index> neighbours_;
  SphereStencil stencil_;
  std::size_t edge_;
  double least_ = 0;  // share of the equal solid angle that no triangle falls below
  double shortest_ = 0;
  std::optional<Index> stopped_by_;
};

}  // namespace winslow::gui
