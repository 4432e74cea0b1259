#pragma once

#include "core/formulation/row_blocks.h"

namespace winslow {

/// The tetrahedra of a volume mesh in parts, for energies, gradients and scalar operators in one
/// pass each. A part has a few thousand rows, as they come in RowBlocks, and the cells of which
/// these are the first. It computes each of its cells once, in coordinates of its own that stay in
/// the fast caches, and hands what belongs to rows of later parts to these. So the sums do not
/// depend on the number of threads.
///
/// Vectors have three numbers for each row, in the order of RowBlocks.
class GradientParts {
 public:
  /// blocks: after renumber_cells(). cells: in the order of the blocks. row_of_node: -1 for nodes
  /// without a row.
  GradientParts(const RowBlocks<3>& blocks, const std::vector<std::array<Index, 4>>& cells,
                std::span<const Index> row_of_node);

  /// The node of each row.
  std::span<const Index> nodes() const { return nodes_; }
  /// The place in the order of the blocks of a row.
  Index position(std::size_t row) const { return position_[row]; }

  std::size_t bytes() const;

  /// Returns the energy, infinite where a cell is inverted. out: receives its derivatives,
  /// undefined if it is infinite.
  double gradient(const distortion::SimplexKernel<3>& kernel, const distortion::SimplexData& data,
                  int threads, std::span<double> out) const;
  /// out: receives two numbers a row, the lengths of the edges in all its cells and the trace of
  /// its diagonal block. Inverted cells count as well.
  void scales(const distortion::SimplexKernel<3>& kernel, const distortion::SimplexData& data,
              int threads, std::span<double> out) const;
  /// The scalar operator of FirstOrderForm::laplacian(), in the order of the rows: the sum over the
  /// cells (SimplexKernel::sum_scalars), with nodes without rows held.
  void laplacian(const distortion::SimplexKernel<3>& kernel, const distortion::SimplexData& data,
                 const RowBlocks<3>& blocks, int threads, SparseMatrix& out) const;

 private:
  static constexpr Index blocks_per_part = 4;
  static constexpr Index rows_per_part = blocks_per_part * RowBlocks<3>::rows_per_block;
  struct Part {
    Index first_cell, end_cell;
    /// Its own rows, then the other nodes of its cells.
    std::vector<Index> nodes;
    std::vector<Index> corners;  ///< #cells by 4: which of these nodes
    /// The nodes with rows of later parts, and the first of their places in the list of all.
    std::vector<Index> handed_on;
    std::size_t first_place = 0;
    /// What earlier parts hand on, in their order: the place in the list, and the own row.
    std::vector<std::array<Index, 2>> received;
  };
  void make_pattern(const RowBlocks<3>& blocks);
  template <std::size_t Numbers, std::size_t Stride, typename AddCells>
  void sum(const double* x, int threads, std::span<double> out, const AddCells& add_cells) const;
  void write_rows(Index first, Index last, std::span<const double> entries,
                  std::span<const double> diagonals, std::span<double> values) const;

  std::vector<Index> nodes_, position_;
  std::vector<Part> parts_;
  std::size_t handed_on_ = 0;                       // by all parts
  std::shared_ptr<const SparsityPattern> pattern_;  // in the order of the blocks
  std::vector<Index> entry_;  // for each of its entries, that of the block's own matrix
};

}  // namespace winslow
