#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "core/formulation/triangle_kernel.h"
#include "core/linear/sparse_system.h"
#include "core/types.h"

namespace winslow {

/// The free nodes (rows) in blocks that lie close together in the mesh, with the triangles around
/// each block. What is worked out for a triangle of a block serves all of the block's rows and is
/// still in the cache for the last of them; a triangle between two blocks is worked out in both.
/// Mesh generators number nodes almost at random, so the blocks follow an order of their own.
class RowBlocks {
 public:
  static constexpr Index rows_per_block = 256;  // a divisor of parallel_block

  /// triangles: nodes, counter-clockwise. row_of_node: -1 for nodes without unknowns.
  RowBlocks(const std::vector<std::array<Index, 3>>& triangles, std::span<const Index> row_of_node,
            Index rows);

  /// 2x2 blocks for every pair of free nodes with a common triangle.
  const std::shared_ptr<const SparsityPattern>& pattern() const { return pattern_; }
  Index rows() const { return static_cast<Index>(order_.size()); }
  /// The row at a position of the blocks' order.
  Index row(Index position) const { return order_[static_cast<std::size_t>(position)]; }
  /// The rows from a position on.
  const Index* order(Index position) const { return order_.data() + position; }
  /// The triangles around a block.
  std::span<const Index> triangles(Index block) const { return part(triangles_, block); }
  /// Where each of them belongs. The block's own matrix has its rows one after the other, in the
  /// order of positions and each as in the pattern, after one entry that nobody needs.
  std::span<const distortion::TrianglePlaces> places(Index block) const {
    return part(places_, block);
  }
  /// Entries of a block's own matrix.
  Index entries(Index block) const { return entries_[static_cast<std::size_t>(block)]; }

  /// Number from which a block's triangles are in no earlier block, once they are renumbered.
  Index first_new_triangle(Index block) const {
    return first_new_[static_cast<std::size_t>(block)];
  }

  /// Numbers the triangles as the blocks meet them. Returns the old number of each.
  std::vector<Index> renumber_triangles();

 private:
  template <typename T>
  std::span<const T> part(const std::vector<T>& all, Index block) const {
    const auto b = static_cast<std::size_t>(block);
    const auto first = static_cast<std::size_t>(triangle_offsets_[b]);
    return {all.data() + first, static_cast<std::size_t>(triangle_offsets_[b + 1]) - first};
  }

  std::shared_ptr<const SparsityPattern> pattern_;
  std::vector<Index> order_;
  std::vector<Index> triangle_offsets_{0};
  std::vector<Index> triangles_;
  std::vector<distortion::TrianglePlaces> places_;
  std::vector<Index> entries_;
  std::vector<Index> first_new_;
};

}  // namespace winslow
