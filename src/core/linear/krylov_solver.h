#pragma once

#include <memory>

#include "core/linear/linear_solver.h"

namespace winslow {

/// Conjugate gradients, preconditioned by an incomplete Cholesky factorisation. Symmetric positive
/// definite matrices only.
std::unique_ptr<LinearSolver> make_cg_solver(const LinearOptions& options, int threads);

/// Conjugate gradients, preconditioned by algebraic multigrid. Symmetric positive definite matrices
/// only.
std::unique_ptr<LinearSolver> make_multigrid_solver(const LinearOptions& options, int threads);

/// Restarted GMRES, preconditioned by an incomplete LU factorisation with threshold (ILUT).
std::unique_ptr<LinearSolver> make_gmres_solver(const LinearOptions& options, int threads);

}  // namespace winslow
