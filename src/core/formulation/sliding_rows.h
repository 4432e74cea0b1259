#pragma once

#include <cmath>

#include "core/formulation/simplex_kernel.h"
#include "core/geometry/sliding_boundary.h"
#include "core/linear/sparse_system.h"
#include "core/problem/node_unknowns.h"
#include "core/problem/smoothing_problem.h"

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

/// What the variational form sums up, row by row.

inline double larger(double a, double b) { return std::isnan(a) || a >= b ? a : b; }

/// Sums of what blocks of rows came to, in the order of the blocks.
struct NormSum {
  double max = 0, squares = 0;
  Index count = 0;

  void add(double scaled) {
    max = larger(max, scaled);
    squares += scaled * scaled;
    ++count;
  }
  static ResidualNorms total(const std::vector<NormSum>& parts) {
    NormSum sum;
    for (const NormSum& part : parts) {
      sum.max = larger(sum.max, part.max);
      sum.squares += part.squares;
      sum.count += part.count;
    }
    return {sum.max, sum.count > 0 ? std::sqrt(sum.squares / sum.count) : 0};
  }
};

/// What the cells around one row came to: diagonal block, gradient, length of their edges at the
/// node.
template <int D>
struct RowSum {
  const double* v;
  const double* gradient() const { return v + distortion::SimplexLayout<D>::gradient; }
  /// Distance by which the node alone would move, over the mean edge. cells: around the node. foot:
  /// of a node that slides; null for others.
  double scaled(Index cells, const Foot* foot) const {
    double square = 0;
    for (std::ptrdiff_t k = 0; k < D; ++k) square += gradient()[k] * gradient()[k];
    const double g = foot ? SlidingRows<D>::along(*foot, gradient()) : std::sqrt(square);
    return scale_of(cells).scaled(g);
  }
  /// What a gradient compares with.
  struct Scale {
    double trace = 0, edges = 0;
    Index cells = 0;
    double scaled(double gradient) const {
      const double mean_edge = edges / (D * std::max<Index>(cells, 1));
      const double scale = trace / D * mean_edge;
      return scale > 0 ? gradient / scale : gradient;
    }
  };
  Scale scale_of(Index cells) const {
    Scale scale{0, gradient()[D], cells};
    for (std::ptrdiff_t k = 0; k < D; ++k) scale.trace += v[(D + 1) * k];
    return scale;
  }
};

}  // namespace winslow
