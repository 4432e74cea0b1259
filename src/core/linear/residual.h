#pragma once

#include <span>

#include "core/linear/sparse_system.h"

namespace winslow {

/// |B - A X| / |B| in the Euclidean norm, worst right-hand side; 0 where B is zero and met.
double relative_residual(const SparseSystem& system, std::span<const double> x);

}  // namespace winslow
