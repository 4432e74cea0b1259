#pragma once

#include <memory>
#include <span>
#include <vector>

#include "core/geometry/curve.h"
#include "core/types.h"

namespace winslow {

/// A curve by its length of arc, places in space: in the plane their third component is 0.
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

/// Nodes one after the other along a curve, and which share of the length each edge between them
/// has. With the first and the last node of the row at the arcs a and b, the node between with
/// share t is at
///
///   s = a + t (b - a)      of an open row,
///   s = a + t period       of a closed one, whose first node leads the others round.
class CurveRow {
 public:
  /// nodes: at least two, three of a closed row, which does not repeat its first; an open one may
  /// begin and end at one node. places: of the nodes, near the curve.
  CurveRow(std::vector<Index> nodes, bool closed, std::shared_ptr<const ArcCurve> curve,
           std::span<const Vec3> places);

  std::span<const Index> nodes() const { return nodes_; }
  bool closed() const { return closed_; }
  /// The nodes whose places say where the others are: of a closed row twice the same.
  Index first() const { return nodes_.front(); }
  Index last() const { return closed_ ? nodes_.front() : nodes_.back(); }
  /// The others.
  std::span<const Index> between() const {
    return std::span(nodes_).subspan(1, nodes_.size() - (closed_ ? 1 : 2));
  }
  /// False of a row round a corner along a curve that is not closed: nothing says how it would go
  /// on there, so that the corner has to stay.
  bool can_follow() const { return !shares_.empty(); }

  /// Of the length from the first node to each of between(), 0 to 1.
  std::span<const double> shares() const { return shares_; }
  /// How much of a move of the last node along the curve, a length of arc, the node with a share
  /// makes; what is left is the first's.
  double part_of_last(std::size_t k) const { return closed_ ? 0 : shares_[k]; }

  /// Where the row is when its first and last nodes are at some places: these two, then between().
  struct Places {
    CurvePoint<3> first, last;
    std::vector<CurvePoint<3>> between;
  };
  Places places(const Vec3& first, const Vec3& last) const;

  /// The lengths of arc of the edges of the row, from one node to the next, at these places of
  /// nodes().
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
