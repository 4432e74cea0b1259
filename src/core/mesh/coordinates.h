#pragma once

#include <cassert>
#include <cstddef>
#include <span>
#include <vector>

#include "core/types.h"

namespace winslow {

/// Coordinates of all nodes: #nodes by dimension, node after node, in the unit of the file.
class Coordinates {
 public:
  Coordinates() = default;
  Coordinates(int dimension, Index node_count)
      : dimension_(dimension),
        values_(static_cast<std::size_t>(dimension) * static_cast<std::size_t>(node_count), 0.0) {}

  int dimension() const { return dimension_; }
  Index size() const {
    return static_cast<Index>(values_.size() / static_cast<std::size_t>(dimension_));
  }
  bool empty() const { return values_.empty(); }

  /// First two components of a node (all of them in 2D).
  Vec2 xy(Index node) const {
    const double* p = point(node);
    return {p[0], p[1]};
  }
  void set_xy(Index node, const Vec2& p) {
    double* q = point(node);
    q[0] = p.x();
    q[1] = p.y();
  }
  void push_xy(const Vec2& p) {
    assert(dimension_ == 2);
    values_.push_back(p.x());
    values_.push_back(p.y());
  }

  const double* point(Index node) const { return values_.data() + offset(node); }
  double* point(Index node) { return values_.data() + offset(node); }

  std::span<const double> values() const { return values_; }
  std::span<double> values() { return values_; }

  bool operator==(const Coordinates&) const = default;

 private:
  std::size_t offset(Index node) const {
    return static_cast<std::size_t>(node) * static_cast<std::size_t>(dimension_);
  }

  int dimension_ = 2;
  std::vector<double> values_;
};

}  // namespace winslow
