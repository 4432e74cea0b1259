#pragma once

#include <memory>
#include <span>
#include <vector>

#include "core/linear/sparse_system.h"
#include "core/problem/node_unknowns.h"

namespace winslow {

/// The rows of nodes that are images of others, in a system of D by D blocks that was assembled as
/// if they had unknowns of their own, after the rows of those that have. With x_s = R x_m + c,
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
  /// Of the rows with unknowns: the full one where there are no images.
  const std::shared_ptr<const SparsityPattern>& pattern() const { return pattern_; }
  /// The row that stands for a row: its own, or that of the node whose image it is.
  Index row(std::size_t full_row) const {
    return empty() ? static_cast<Index>(full_row) : row_[full_row];
  }
  /// Whether a row has images, or is one: its own gradient is part of one.
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

}  // namespace winslow
