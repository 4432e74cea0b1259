#pragma once

#include <memory>

#include "core/linear/preconditioner.h"

namespace winslow {

/// One W-cycle of algebraic multigrid by smoothed aggregation (P. Vanek, J. Mandel and M. Brezina,
/// Computing 56, 1996) with block Gauss-Seidel smoothing, forward on the way down and backward on
/// the way up, so that it is symmetric. The components of the constant vector are what the coarse
/// levels represent exactly: the rigid translations of a mesh.
///
/// For symmetric positive definite matrices. The hierarchy of aggregates is kept while the pattern
/// object stays, the values on it are rebuilt. In single precision. threads: 0 for all cores; no
/// result depends on it.
std::unique_ptr<Preconditioner> make_multigrid(int threads);

}  // namespace winslow
