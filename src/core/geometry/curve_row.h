#pragma once

#include "core/geometry/curve.h"
#include "core/types.h"

namespace winslow {

/// A curve parametrised by arc length. Points have three components; in the plane the third is 0.
class ArcCurve {
 public:
  virtual ~ArcCurve() = default;
  // As of Curve.
  virtual double arc_of(const Vec3& point) const = 0;
  virtual CurvePoint<3> at_arc(double arc) const = 0;
  virtual double period() const = 0;
};

std::shared_ptr<const ArcCurve> by_arc(std::shared_ptr<const PlaneCurve> curve);
std::shared_ptr<const ArcCurve> by_arc(std::shared_ptr<const SpaceCurve> curve);

/// A row of nodes along a curve that keeps its spacing: each edge keeps its share of the row's
/// length. With the first and the last node at the arc lengths a and b, a node with the share t is
/// at
///
///   s = a + t (b - a)      in an open row,
///   s = a + t period       in a closed row, in which all nodes follow the first.
class CurveRow {
 public:
  /// nodes: at least two, three of a closed row, which does not repeat its first; an open one may
  /// begin and end at one node. places: of the nodes, near the curve.
  CurveRow(std::vector<Index> nodes, bool closed, std::shared_ptr<const ArcCurve> curve,
           std::span<const Vec3> places);

  std::span<const Index> nodes() const { return nodes_; }
  bool closed() const { return closed_; }
  /// The nodes that determine where the others are. In a closed row they are the same node.
  Index first() const { return nodes_.front(); }
  Index last() const { return closed_ ? nodes_.front() : nodes_.back(); }
  /// All other nodes.
  std::span<const Index> between() const {
    return std::span(nodes_).subspan(1, nodes_.size() - (closed_ ? 1 : 2));
  }
  /// False for a row that begins and ends at one corner of an open curve: the curve ends there, so
  /// that the corner cannot slide.
  bool can_follow() const { return !shares_.empty(); }

  /// For each of between(), the part of the row's length from the first node to it, 0 to 1.
  std::span<const double> shares() const { return shares_; }
  /// Derivative of the arc length of between()[k] by that of the last node. The derivative by that
  /// of the first node is 1 minus this.
  double part_of_last(std::size_t k) const { return closed_ ? 0 : shares_[k]; }

  /// The points of a row.
  struct Places {
    CurvePoint<3> first, last;
    std::vector<CurvePoint<3>> between;
  };
  /// Where the nodes are if the first and the last are at the points nearest to these.
  Places places(const Vec3& first, const Vec3& last) const;

  /// Arc lengths of the edges of the row, in its order. places: of nodes().
  std::vector<double> edge_lengths(std::span<const Vec3> places) const;

 private:
  double arc_between(double from, double to) const;

  std::vector<Index> nodes_;
  bool closed_;
  std::shared_ptr<const ArcCurve> curve_;
  double length_ = 0;  // from first to last as given, its sign the way along the curve
  std::vector<double> shares_;
};

}  // namespace winslow
