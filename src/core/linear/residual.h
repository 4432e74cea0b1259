#pragma once

#include <span>

#include "core/linear/sparse_system.h"

namespace winslow {

/// |B - A X| / |B| in the Euclidean norm, worst right-hand side; 0 where B is zero and met. rhs, x:
/// #scalar rows by columns, row after row. NaN if x is not finite. threads: 0 for all cores.
double relative_residual(const SparseMatrix& matrix, std::span<const double> rhs, int columns,
                         std::span<const double> x, int threads = 1);

}  // namespace winslow
