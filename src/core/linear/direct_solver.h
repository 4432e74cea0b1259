#pragma once

#include <memory>

#include "core/linear/linear_solver.h"

namespace winslow {

/// Sparse Cholesky for symmetric matrices, sparse LU for others. With the factor of an earlier
/// matrix (set_matrix with keep) it solves by conjugate gradients or GMRES preconditioned by that
/// factor, and factorises after all where that does not converge.
std::unique_ptr<LinearSolver> make_direct_solver(const LinearOptions& options, int threads);

}  // namespace winslow
