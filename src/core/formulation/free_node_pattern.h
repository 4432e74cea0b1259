#pragma once

#include <memory>
#include <vector>

#include "core/linear/sparse_system.h"
#include "core/mesh/topology.h"

namespace winslow {

/// Pattern of the free nodes of a mesh: row i is free node i and its free neighbours.
struct FreeNodePattern {
  explicit FreeNodePattern(const Topology& topology);

  std::shared_ptr<const SparsityPattern> pattern;
  std::vector<Index> row_of_node;  ///< #nodes, -1 for nodes that are not free
  /// For each entry of Topology::neighbour_rows(): where its matrix entry lies, -1 if there is
  /// none.
  std::vector<Index> entry_of_neighbour;
};

}  // namespace winslow
