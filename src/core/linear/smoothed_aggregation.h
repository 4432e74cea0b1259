#pragma once

#include <span>

#include "core/linear/blocks.h"
#include "core/linear/sparse_system.h"

namespace winslow {

/// A partition of the rows of a symmetric pattern into connected patches.
struct Aggregates {
  std::vector<Index> of_row;  ///< #rows; -1 for rows that belong to none
  Index count = 0;
};

/// Forms patches of rows and their neighbours, greedily in the order of the rows (P. Vanek, J.
/// Mandel and M. Brezina, Computing 56, 1996, algorithm 5.1). strong: for each entry, whether it
/// connects; empty: all do. Rows without connections belong to none.
Aggregates aggregate(const SparsityPattern& graph, std::span<const char> strong = {});

/// Orders rows so that rows close in the graph are close in memory: hierarchical patches, each
/// contiguous. Element k is the k-th row in the new order.
std::vector<Index> locality_ordering(const SparsityPattern& graph);

/// Interpolation of smoothed aggregation: from one value per aggregate to one per row,
///
///   P = (I - omega D^-1 F) T,
///
/// T constant on each aggregate, component by component, and F the matrix without its weak
/// entries, which are lumped into its diagonal D so that F has the same null space of constants
/// (P. Vanek, J. Mandel and M. Brezina, Computing 56, 1996). Aggregates and weak entries are chosen
/// by the first matrix of a pattern; the values are rebuilt for each matrix.
class Prolongation {
 public:
  /// strength: entries with |A_ij|^2 <= strength^2 |A_ii| |A_jj| (Frobenius) are weak.
  Prolongation(const SparseMatrix& matrix, double strength);

  /// Values for a matrix of the same pattern.
  void build(const SparseMatrix& matrix, int threads);

  /// x += P coarse; copies the result into `copy`. width: right-hand sides at once, 1, or 4 of a
  /// scalar matrix. Vectors have row_stride(block, width) numbers a row.
  void prolong(std::span<const Real> coarse, std::span<Real> x, std::span<Real> copy, int threads,
               int width = 1) const;
  /// coarse = P^T r.
  void restrict(std::span<const Real> r, std::span<Real> coarse, int threads, int width = 1) const;

  /// How many blocks P has.
  std::size_t entries() const { return columns_.size(); }
  std::size_t bytes() const {
    return bytes_of(strong_, offsets_, columns_, own_, entry_, values_) +
           bytes_of(transposed_offsets_, transposed_rows_, transposed_entries_);
  }

  Index coarse_rows() const { return static_cast<Index>(transposed_offsets_.size()) - 1; }

  /// P^T A P. The first call computes the pattern.
  void galerkin(const SparseMatrix& matrix, SparseMatrix& coarse, int threads) const;

 private:
  void choose_strong(const SparseMatrix& matrix, double strength);
  void structure(const SparsityPattern& pattern, const Aggregates& aggregates);
  void transpose();
  template <int B>
  void build_rows(const SparseMatrix& matrix, Index begin, Index end);
  std::shared_ptr<const SparsityPattern> galerkin_pattern(const SparsityPattern& fine,
                                                          int threads) const;
  template <int B, int N>
  Row<N> interpolated(Index first, Index last, std::span<const Real> coarse) const;
  template <int B>
  void galerkin_rows(const SparseMatrix& matrix, SparseMatrix& coarse, Index begin,
                     Index end) const;

  int block_;
  Index rows_;
  std::vector<char> strong_;    // #entries of the matrix
  std::vector<Index> offsets_;  // #rows + 1
  std::vector<Index> columns_;  // aggregates that contribute to a row
  std::vector<Index> own_;      // #rows: entry of the row's own aggregate, -1 for none
  std::vector<Index>
      entry_;  // #entries of the matrix: the entry of P to which it contributes, -1 if weak
  std::vector<Real> values_;               // blocks, row-major, and a tail
  std::vector<Index> transposed_offsets_;  // #aggregates + 1
  std::vector<Index> transposed_rows_, transposed_entries_;
};

}  // namespace winslow
