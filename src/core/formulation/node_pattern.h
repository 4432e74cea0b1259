#pragma once

#include <memory>
#include <span>
#include <vector>

#include "core/linear/sparse_system.h"
#include "core/mesh/topology.h"

namespace winslow {

/// Pattern of the systems of some nodes of a mesh: row i is node i of them and those of its
/// neighbours that are among them.
struct NodePattern {
  /// nodes: ascending.
  NodePattern(const Topology& topology, std::span<const Index> nodes);

  std::shared_ptr<const SparsityPattern> pattern;
  std::vector<Index> row_of_node;  ///< #nodes, -1 for nodes without a row
  /// For each entry of Topology::neighbour_rows(): where its matrix entry lies, -1 if there is
  /// none.
  std::vector<Index> entry_of_neighbour;
};

}  // namespace winslow
