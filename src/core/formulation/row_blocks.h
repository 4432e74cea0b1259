#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

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

  /// One triangle as a row sees it.
  struct Incidence {
    Index triangle;        ///< place in the block's list
    Index local;           ///< place of the row's node in the triangle
    Index slot_j, slot_k;  ///< entries of the matrix at the next two nodes; -1: constrained
  };

  /// triangles: nodes, counter-clockwise. row_of_node: -1 for constrained nodes.
  RowBlocks(const std::vector<std::array<Index, 3>>& triangles, std::span<const Index> row_of_node,
            Index rows);

  /// 2x2 blocks for every pair of free nodes with a common triangle.
  const std::shared_ptr<const SparsityPattern>& pattern() const { return pattern_; }
  Index rows() const { return static_cast<Index>(order_.size()); }
  /// The row at a position of the blocks' order.
  Index row(Index position) const { return order_[static_cast<std::size_t>(position)]; }
  std::span<const Incidence> incidences(Index position) const {
    const auto p = static_cast<std::size_t>(position);
    const auto first = static_cast<std::size_t>(incidence_offsets_[p]);
    return {incidences_.data() + first,
            static_cast<std::size_t>(incidence_offsets_[p + 1]) - first};
  }
  /// The triangles around a block.
  std::span<const Index> triangles(Index block) const {
    const auto b = static_cast<std::size_t>(block);
    const auto first = static_cast<std::size_t>(triangle_offsets_[b]);
    return {triangles_.data() + first, static_cast<std::size_t>(triangle_offsets_[b + 1]) - first};
  }

 private:
  std::shared_ptr<const SparsityPattern> pattern_;
  std::vector<Index> order_;
  std::vector<Index> incidence_offsets_{0};
  std::vector<Incidence> incidences_;
  std::vector<Index> triangle_offsets_{0};
  std::vector<Index> triangles_;
};

}  // namespace winslow
