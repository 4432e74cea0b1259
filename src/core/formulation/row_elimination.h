#pragma once

#include <cmath>

#include "core/formulation/simplex_kernel.h"
#include "core/geometry/sliding_boundary.h"
#include "core/linear/sparse_system.h"
#include "core/problem/node_unknowns.h"
#include "core/problem/smoothing_problem.h"

namespace winslow {

/// Eliminates the nodes that follow the ends of a CurveRow from a system of D by D blocks. The
/// system was assembled as if these followers had unknowns of their own; their matrix rows come
/// last. A follower k at arc length s_k has the tangent t_k and the curvature vector c_k. The ends
/// m of its row have the tangents t_m; p_km is the derivative of s_k by the arc length of end m. So
/// the follower moves by
///
///   ds_k = sum_m v_km . dx_m,   v_km = p_km t_m,
///
/// and by the chain rule, with C_km = t_k v_km^T, to second order
///
///   R_m += C_km^T R_k,   H_ij -> H_ij + C_ki^T H_kl C_lj over all (k, l) that follow (i, j),
///   H_ij += (dE/dx_k . c_k) v_ki v_kj^T.
///
/// Ends that do not move contribute nothing.
template <int D>
class FollowerRows {
 public:
  /// row_of_node: -1 for nodes that do not move. full: pattern of all rows, those of followers
  /// last.
  FollowerRows(const NodeUnknowns& nodes, std::span<const Index> row_of_node,
               std::shared_ptr<const SparsityPattern> full);

  bool empty() const { return ends_.empty(); }
  /// Pattern of the other rows: the full one if nothing follows.
  const std::shared_ptr<const SparsityPattern>& pattern() const { return pattern_; }
  /// The rows to which a row's gradient contributes: itself, or the ends; -1 for none.
  std::array<Index, 2> rows(std::size_t full_row) const {
    if (full_row < own_) return {static_cast<Index>(full_row), -1};
    return ends_[full_row - own_];
  }
  /// Whether a row follows, or is followed.
  bool is_part(std::size_t full_row) const { return !empty() && part_[full_row] != 0; }

  /// The derivatives of one follower's position.
  struct Lever {
    Vec<D> tangent = Vec<D>::Zero(), curvature = Vec<D>::Zero();
    std::array<Vec<D>, 2> ends{Vec<D>::Zero(), Vec<D>::Zero()};  ///< v_km
  };
  /// The levers of all followers at x, in order.
  std::vector<Lever> levers(const NodeUnknowns& nodes, const Coordinates& x) const;

  /// full: over all rows; out: over the others.
  void reduce(std::span<const Lever> levers, std::span<const double> full,
              std::span<double> out) const;
  /// residual: over all rows, -dE/dx. convex: omits negative curvature terms, so that a positive
  /// semidefinite matrix stays so.
  void reduce(std::span<const Lever> levers, std::span<const double> residual, bool convex,
              const SparseMatrix& full, SparseMatrix& out) const;

 private:
  using Block = Eigen::Matrix<double, D, D, Eigen::RowMajor>;
  struct Part {
    Index row;
    Block block;  // C, the identity for the row itself
  };
  struct Parts {
    std::array<Part, 2> parts;
    int count = 0;
  };
  Parts parts_of(std::span<const Lever> levers, std::size_t full_row) const;

  std::size_t own_ = 0;                     // rows that do not follow
  std::vector<std::array<Index, 2>> ends_;  // rows of the ends of each follower
  std::vector<unsigned char> part_;         // #all rows
  std::shared_ptr<const SparsityPattern> full_, pattern_;
};

extern template class FollowerRows<2>;
extern template class FollowerRows<3>;

/// Eliminates the images of nodes across periodic boundaries from a system of D by D blocks. The
/// system was assembled as if images had unknowns of their own; their matrix rows come last. With
/// the image s of the node m at x_s = R x_m + c,
///
///   R_m -> R_m + R^T R_s,   H_ij -> H_ij + C_i^T H_st C_j over all (s, t) that stand for (i, j),
///
/// C = R for the row of an image, the identity for others.
template <int D>
class PeriodicRows {
 public:
  /// full: pattern of all rows, those of nodes.nodes() first, then those of nodes.images().
  PeriodicRows(const NodeUnknowns& nodes, std::shared_ptr<const SparsityPattern> full);

  bool empty() const { return rotation_.empty(); }
  /// Pattern of the rows with unknowns: the full one if there are no images.
  const std::shared_ptr<const SparsityPattern>& pattern() const { return pattern_; }
  /// The row with unknowns of a row: itself, or that of the node whose image it is.
  Index row(std::size_t full_row) const {
    return empty() ? static_cast<Index>(full_row) : row_[full_row];
  }
  /// Whether a row has images or is one: its gradient is then combined with others.
  bool is_part(std::size_t full_row) const { return !empty() && part_[full_row] != 0; }

  /// full: over all rows; out: over those with unknowns.
  void reduce(std::span<const double> full, std::span<double> out) const;
  void reduce(const SparseMatrix& full, SparseMatrix& out) const;

 private:
  using Block = Eigen::Matrix<double, D, D, Eigen::RowMajor>;
  const Block* rotation(std::size_t full_row) const {
    return full_row < own_ ? nullptr : &rotation_[full_row - own_];
  }

  std::size_t own_ = 0;              // rows with unknowns
  std::vector<Block> rotation_;      // of each image
  std::vector<Index> row_;           // #all rows
  std::vector<unsigned char> part_;  // #all rows
  std::vector<Index> entry_;         // #entries of the full pattern: in the reduced one
  std::vector<Index> row_of_entry_;  // #entries of the full pattern
  std::shared_ptr<const SparsityPattern> full_, pattern_;
};

extern template class PeriodicRows<2>;
extern template class PeriodicRows<3>;

/// Curvature terms of a foot in the second derivatives with respect to its unknowns. gradient: of
/// the energy with respect to the node's position. convex: only the positive semidefinite part.
Eigen::Matrix2d bending(const Foot& foot, const Vec3& gradient, bool convex);

/// Restricts the rows of sliding nodes in a system of D by D blocks that was assembled as if all
/// nodes were free. Q_i are the directions of node i's frame (D by #unknowns of the node), and
/// x_i(u) = foot(x_i + Q_i u). By the chain rule
///
///   R_i -> Q_i^T R_i,   H_ij -> Q_i^T H_ij Q_j,   H_ii += sum_kl (dE/dx_i . bend_kl),
///
/// the last term from the curvature of the curve or surface. Surplus numbers of a block, beyond the
/// unknowns of its node, get a zero residual and an identity equation.
template <int D>
class SlidingRows {
 public:
  /// nodes: in blocks. pattern: rows in the order of nodes.nodes(); symmetric.
  SlidingRows(const NodeUnknowns& nodes, const SparsityPattern& pattern);

  bool empty() const { return rows_.empty(); }
  /// Index of a row among the sliding rows; -1 for the others.
  Index slot(std::size_t row) const { return slot_.empty() ? -1 : slot_[row]; }

  /// The feet of all sliding nodes at x, in order.
  std::vector<Foot> feet(const NodeUnknowns& nodes, const Coordinates& x) const;

  /// Length of the component of a vector along the directions of a foot.
  static double along(const Foot& foot, const double* v);
  /// Restricts a residual over all rows.
  void restrict(std::span<const Foot> feet, std::span<double> residual) const;
  /// residual: before restrict(), -dE/dx. convex: omits negative curvature terms, so that a
  /// positive semidefinite matrix stays so.
  void restrict(std::span<const Foot> feet, std::span<const double> residual, bool convex,
                SparseMatrix& matrix) const;

 private:
  std::vector<Index> rows_;  // ascending
  std::vector<Index> slot_;  // #rows of the pattern; empty if none slides
};

extern template class SlidingRows<2>;
extern template class SlidingRows<3>;

/// The sums of the variational form, row by row.

inline double larger(double a, double b) { return std::isnan(a) || a >= b ? a : b; }

/// Sums of the scaled residuals of rows; blocks of rows are summed in order.
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

/// Sum over the cells around one row: diagonal block, gradient, length of the edges at the node.
template <int D>
struct RowSum {
  const double* v;
  const double* gradient() const { return v + distortion::SimplexLayout<D>::gradient; }
  /// Distance by which the node alone would move, divided by the mean edge length. cells: around
  /// the node. foot: of a sliding node; null for others.
  double scaled(Index cells, const Foot* foot) const {
    double square = 0;
    for (std::ptrdiff_t k = 0; k < D; ++k) square += gradient()[k] * gradient()[k];
    const double g = foot ? SlidingRows<D>::along(*foot, gradient()) : std::sqrt(square);
    return scale_of(cells).scaled(g);
  }
  /// The scale of a gradient.
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
