#pragma once

#include <memory>

#include "core/linear/preconditioner.h"

namespace winslow {

/// Incomplete Cholesky factorisation without fill, by blocks, of the parts of a matrix that lie
/// within runs of parallel_block rows; what connects different runs is left out, so that runs are
/// factorised and solved side by side. A pivot that is not safely positive is replaced by the block
/// of the matrix itself. For symmetric positive definite matrices. threads: 0 for all cores.
std::unique_ptr<Preconditioner> make_incomplete_cholesky(int threads);

}  // namespace winslow
