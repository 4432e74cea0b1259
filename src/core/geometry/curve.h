#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/types.h"

namespace winslow {

/// A place on a curve of the plane or of space.
template <int D>
struct CurvePoint {
  Vec<D> point = Vec<D>::Zero();
  Vec<D> tangent = Vec<D>::UnitX();   ///< of length 1
  Vec<D> curvature = Vec<D>::Zero();  ///< derivative of the tangent by the length of arc, 1/length
};

/// A curve that boundary nodes slide along.
template <int D>
class Curve {
 public:
  virtual ~Curve() = default;
  /// The place nearest to a point. A straight line goes on beyond its ends.
  virtual CurvePoint<D> nearest(const Vec<D>& point) const = 0;
  /// Length of arc from where the curve begins to the place nearest to a point, in units of the
  /// mesh; of a closed curve from 0 on, less than its period.
  virtual double arc_of(const Vec<D>& point) const = 0;
  /// The place at a length of arc. A straight line goes on beyond its ends, a closed curve round
  /// and round; others end.
  virtual CurvePoint<D> at_arc(double arc) const = 0;
  /// Length of a closed curve; 0 of an open one.
  virtual double period() const = 0;
  /// "straight line", "circle of radius 10", "smooth curve through 200 nodes": for reports.
  virtual std::string description() const = 0;
};

using PlaneCurve = Curve<2>;
using SpaceCurve = Curve<3>;

/// The curve through a row of points (closed: the last is joined to the first): a straight line or
/// a circle where all of them lie on one to within `tolerance` times the extent of the row, else
/// the cubic spline that is twice continuously differentiable, its parameter the length of the
/// chords (natural at the ends of an open row). At least two points, three of a closed row, no two
/// neighbours at one place: else UsageError.
std::unique_ptr<const PlaneCurve> curve_through(std::span<const Vec2> points, bool closed,
                                                double tolerance = 1e-6);
std::unique_ptr<const SpaceCurve> curve_through(std::span<const Vec3> points, bool closed,
                                                double tolerance = 1e-6);

}  // namespace winslow
