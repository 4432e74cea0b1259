#pragma once

#include <span>
#include <vector>

#include "core/geometry/sliding_geometry.h"
#include "core/linear/sparse_system.h"
#include "core/problem/node_unknowns.h"

namespace winslow {

/// What the bends of a foot add to the second derivatives by its unknowns. gradient: of the energy
/// by the node's place. convex: only what curves upwards.
Eigen::Matrix2d bending(const Foot& foot, const Vec3& gradient, bool convex);

/// The rows of nodes that slide, in a system of D by D blocks that was assembled as if all nodes
/// were free. With Q_i the directions of node i's frame (D by its unknowns), its unknowns u are
/// those of x_i(u) = foot(x_i + Q_i u), so that by the chain rule
///
///   R_i -> Q_i^T R_i,   H_ij -> Q_i^T H_ij Q_j,   H_ii += sum_kl (dE/dx_i . bend_kl),
///
/// the last by the curvature of what it slides on. Numbers of a block beyond the unknowns of its
/// node stand for nothing: zero residual, their own equation.
template <int D>
class SlidingRows {
 public:
  /// nodes: in blocks. pattern: rows in the order of nodes.nodes(); symmetric.
  SlidingRows(const NodeUnknowns& nodes, const SparsityPattern& pattern);

  bool empty() const { return rows_.empty(); }
  /// Number of a row among those that slide; -1 for the others.
  Index slot(std::size_t row) const { return slot_.empty() ? -1 : slot_[row]; }

  /// Where the nodes that slide are at x, one after the other.
  std::vector<Foot> feet(const NodeUnknowns& nodes, const Coordinates& x) const;

  /// Length of the part of a vector along the directions of a foot.
  static double along(const Foot& foot, const double* v);
  /// Of a residual over all rows.
  void restrict(std::span<const Foot> feet, std::span<double> residual) const;
  /// residual: before restrict(), -dE/dx. convex: only what the curvature adds, nothing that it
  /// takes away, so that a positive semidefinite matrix stays so.
  void restrict(std::span<const Foot> feet, std::span<const double> residual, bool convex,
                SparseMatrix& matrix) const;

 private:
  std::vector<Index> rows_;  // ascending
  std::vector<Index> slot_;  // #rows of the pattern; empty if none slides
};

extern template class SlidingRows<2>;
extern template class SlidingRows<3>;

}  // namespace winslow
