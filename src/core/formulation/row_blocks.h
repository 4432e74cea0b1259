#pragma once

#include <array>
#include <span>

#include "core/formulation/simplex_kernel.h"
#include "core/linear/sparse_system.h"
#include "core/types.h"

namespace winslow {

/// The free nodes (rows) in blocks that lie close together in the mesh, with the cells (triangles
/// in the plane, tetrahedra in space) around each block. What is worked out for a cell of a block
/// serves all of the block's rows and is still in the cache for the last of them; a cell between
/// two blocks is worked out in both, so blocks of space, which have more surface, are larger. Mesh
/// generators number nodes almost at random, so the blocks follow an order of their own.
template <int D>
class RowBlocks {
 public:
  using Cell = std::array<Index, D + 1>;
  static constexpr Index rows_per_block = D == 2 ? 256 : 512;  // a divisor of parallel_block

  /// cells: nodes. row_of_node: -1 for nodes without unknowns.
  RowBlocks(const std::vector<Cell>& cells, std::span<const Index> row_of_node, Index rows,
            int threads);

  /// D by D blocks for every pair of free nodes with a common cell.
  const std::shared_ptr<const SparsityPattern>& pattern() const { return pattern_; }
  Index rows() const { return static_cast<Index>(order_.size()); }
  /// The row at a position of the blocks' order.
  Index row(Index position) const { return order_[static_cast<std::size_t>(position)]; }
  /// The rows from a position on.
  const Index* order(Index position) const { return order_.data() + position; }
  /// The cells around a block.
  std::span<const Index> cells(Index block) const { return part(cells_, block); }
  /// Where each of them belongs. The block's own matrix has its rows one after the other, in the
  /// order of positions and each as in the pattern, after one entry that nobody needs.
  std::span<const distortion::SimplexPlaces<D>> places(Index block) const {
    return part(places_, block);
  }
  /// Entries of a block's own matrix.
  Index entries(Index block) const { return entries_[static_cast<std::size_t>(block)]; }

  /// Number from which a block's cells are in no earlier block, once they are renumbered.
  Index first_new_cell(Index block) const { return first_new_[static_cast<std::size_t>(block)]; }

  /// Numbers the cells as the blocks meet them. Returns the old number of each.
  std::vector<Index> renumber_cells();

 private:
  template <typename T>
  std::span<const T> part(const std::vector<T>& all, Index block) const {
    const auto b = static_cast<std::size_t>(block);
    const auto first = static_cast<std::size_t>(cell_offsets_[b]);
    return {all.data() + first, static_cast<std::size_t>(cell_offsets_[b + 1]) - first};
  }

  std::shared_ptr<const SparsityPattern> pattern_;
  std::vector<Index> order_;
  std::vector<Index> cell_offsets_{0};
  std::vector<Index> cells_;
  std::vector<distortion::SimplexPlaces<D>> places_;
  std::vector<Index> entries_;
  std::vector<Index> first_new_;
};

}  // namespace winslow
