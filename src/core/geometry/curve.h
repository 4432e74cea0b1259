#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/types.h"

namespace winslow {

/// A point of a curve in the plane or in space.
template <int D>
struct CurvePoint {
  Vec<D> point = Vec<D>::Zero();
  Vec<D> tangent = Vec<D>::UnitX();   ///< of length 1
  Vec<D> curvature = Vec<D>::Zero();  ///< derivative of the tangent by the arc length, 1/length
};

/// A curve that boundary nodes slide along.
template <int D>
class Curve {
 public:
  virtual ~Curve() = default;
  /// The point of the curve nearest to a point. Straight lines are infinite.
  virtual CurvePoint<D> nearest(const Vec<D>& point) const = 0;
  /// Arc length from the start of the curve to its point nearest to a point, in units of the mesh;
  /// on a closed curve in [0, period).
  virtual double arc_of(const Vec<D>& point) const = 0;
  /// The point at an arc length. Straight lines are infinite, closed curves are periodic, and other
  /// curves end: arc lengths beyond their ends give the end.
  virtual CurvePoint<D> at_arc(double arc) const = 0;
  /// Length of a closed curve; 0 of an open one.
  virtual double period() const = 0;
  /// Whether the curve extends beyond its points: a straight line or a circle.
  virtual bool goes_on() const { return false; }
  /// "straight line", "circle of radius 10", "smooth curve through 200 nodes": for reports.
  virtual std::string description() const = 0;
};

using PlaneCurve = Curve<2>;
using SpaceCurve = Curve<3>;

/// The curve through a row of points (closed: the last is connected with the first). It is a
/// straight line or a circle if all points lie on one within `tolerance` times the extent of the
/// row. Else it is the twice continuously differentiable cubic spline with the chord length as
/// parameter, natural at the ends of an open row. Throws UsageError for fewer than two points, or
/// three of a closed row, and for equal neighbours.
std::unique_ptr<const PlaneCurve> curve_through(std::span<const Vec2> points, bool closed,
                                                double tolerance = 1e-6);
std::unique_ptr<const SpaceCurve> curve_through(std::span<const Vec3> points, bool closed,
                                                double tolerance = 1e-6);

inline Vec3 lifted(const Vec2& p) { return {p.x(), p.y(), 0}; }
/// The curve in the plane z = 0 of space. It ignores z of points.
std::shared_ptr<const SpaceCurve> lifted(std::shared_ptr<const PlaneCurve> curve);

/// A row of nodes along a curve that keeps its spacing: each edge keeps its share of the length of
/// the row. With the first and the last node at the arc lengths a and b, a node with the share t is
/// at
///
///   s = a + t (b - a)      in an open row,
///   s = a + t period       in a closed row, which the first node determines.
class CurveRow {
 public:
  /// nodes: at least two; of a closed row at least three, and the first is not repeated. An open
  /// row may begin and end at one node. places: positions of the nodes, near the curve.
  CurveRow(std::vector<Index> nodes, bool closed, std::shared_ptr<const SpaceCurve> curve,
           std::span<const Vec3> places);

  std::span<const Index> nodes() const { return nodes_; }
  bool closed() const { return closed_; }
  /// The nodes that determine the others. In a closed row they are the same node.
  Index first() const { return nodes_.front(); }
  Index last() const { return closed_ ? nodes_.front() : nodes_.back(); }
  /// All other nodes.
  std::span<const Index> between() const {
    return std::span(nodes_).subspan(1, nodes_.size() - (closed_ ? 1 : 2));
  }
  /// False for a row that begins and ends at one corner of an open curve. The curve ends there, so
  /// the corner cannot slide.
  bool can_move() const { return !shares_.empty(); }

  /// For each node of between(), its distance from the first node as a share of the length of the
  /// row, 0 to 1.
  std::span<const double> shares() const { return shares_; }
  /// Derivative of the arc length of between()[k] by that of the last node. Its derivative by that
  /// of the first node is 1 minus this.
  double part_of_last(std::size_t k) const { return closed_ ? 0 : shares_[k]; }

  /// The points of all nodes of a row.
  struct Places {
    CurvePoint<3> first, last;
    std::vector<CurvePoint<3>> between;
  };
  /// The points of all nodes if the first and the last node are at the points nearest to these.
  Places places(const Vec3& first, const Vec3& last) const;

  /// Arc lengths of the edges of the row, in its order. places: of nodes().
  std::vector<double> edge_lengths(std::span<const Vec3> places) const;

 private:
  double arc_between(double from, double to) const;

  std::vector<Index> nodes_;
  bool closed_;
  std::shared_ptr<const SpaceCurve> curve_;
  double length_ = 0;  // from first to last as given, negative against the curve
  std::vector<double> shares_;
};

}  // namespace winslow
