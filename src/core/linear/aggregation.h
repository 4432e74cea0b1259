#pragma once

#include <span>
#include <vector>

#include "core/linear/sparse_system.h"

namespace winslow {

/// A partition of the rows of a symmetric pattern into connected patches.
struct Aggregates {
  std::vector<Index> of_row;  ///< #rows; -1 for rows that belong to none
  Index count = 0;
};

/// Patches of rows and their neighbours, greedily in the order of the rows (P. Vanek, J. Mandel and
/// M. Brezina, Computing 56, 1996, algorithm 5.1). strong: for each entry, whether it connects;
/// empty for all. Rows that nothing connects belong to none.
Aggregates aggregate(const SparsityPattern& graph, std::span<const char> strong = {});

/// Order in which rows that are close in the graph lie close in memory: patches of patches of
/// patches, each contiguous. Element k is the row that comes k-th.
std::vector<Index> locality_ordering(const SparsityPattern& graph);

}  // namespace winslow
