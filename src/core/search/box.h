#pragma once

#include <cmath>
#include <limits>

#include "core/types.h"

namespace winslow {

/// An axis-aligned box in D dimensions, its faces included. What is degenerate (a point, a segment,
/// a rectangle in space) is a box like any other.
template <int D>
struct Box {
  Vec<D> min = Vec<D>::Zero();
  Vec<D> max = Vec<D>::Zero();

  /// Holds no point; the neutral element of add().
  static Box empty() {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    return {Vec<D>::Constant(infinity), Vec<D>::Constant(-infinity)};
  }

  Vec<D> centre() const { return 0.5 * (min + max); }
  Vec<D> size() const { return max - min; }

  /// Grows until it holds the point, or the other box, too.
  void add(const Vec<D>& point) { add(Box{point, point}); }
  void add(const Box& other) {
    min = min.cwiseMin(other.min);
    max = max.cwiseMax(other.max);
  }

  /// They have a point in common.
  bool overlaps(const Box& other) const {
    return (min.array() <= other.max.array()).all() && (other.min.array() <= max.array()).all();
  }
  /// Euclidean distance from a point to the nearest point of the box: 0 within.
  double distance(const Vec<D>& point) const { return std::sqrt(squared_distance(point)); }
  double squared_distance(const Vec<D>& point) const {
    return (point - point.cwiseMax(min).cwiseMin(max)).squaredNorm();
  }

  bool operator==(const Box&) const = default;
};

}  // namespace winslow
