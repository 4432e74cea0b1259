#pragma once

#include <memory>
#include <vector>

#include "core/mesh/topology.h"
#include "core/types.h"

namespace winslow {

/// Pattern of a sparse matrix in compressed rows, columns ascending, diagonal always present.
struct SparsityPattern {
  std::vector<Index> offsets{0};
  std::vector<Index> columns;
  std::vector<Index> diagonal;  ///< position of the diagonal entry of each row

  Index rows() const { return static_cast<Index>(offsets.size()) - 1; }
};

/// A X = B with several right-hand sides.
struct SparseSystem {
  std::shared_ptr<const SparsityPattern> pattern;
  std::vector<double> values;  ///< #entries of A
  int columns = 1;             ///< right-hand sides
  std::vector<double> rhs;     ///< #rows by columns, row after row
};

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
