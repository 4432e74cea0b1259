#pragma once

#include "core/linear/linear_solver.h"

namespace winslow {

/// Sparse Cholesky for symmetric matrices, sparse LU for others. With the factor of an earlier
/// matrix (set_matrix with keep) it solves by conjugate gradients or GMRES preconditioned by that
/// factor, and factorises after all where that does not converge.
std::unique_ptr<LinearSolver> make_direct_solver(const LinearOptions& options, int threads);

/// Conjugate gradients, preconditioned by an incomplete Cholesky factorisation. Symmetric positive
/// definite matrices only.
std::unique_ptr<LinearSolver> make_cg_solver(const LinearOptions& options, int threads);

/// Conjugate gradients, preconditioned by algebraic multigrid. Symmetric positive definite matrices
/// only.
std::unique_ptr<LinearSolver> make_multigrid_solver(const LinearOptions& options, int threads);

/// Restarted GMRES, preconditioned by an incomplete LU factorisation with threshold (ILUT).
std::unique_ptr<LinearSolver> make_gmres_solver(const LinearOptions& options, int threads);

/// Gauss-Seidel sweeps over the rows of blocks, alternately forward and backward: the simple solver
/// that AIAA 2009-1362 mentions first. There is nothing of a matrix that it could keep.
std::unique_ptr<LinearSolver> make_point_implicit_solver(const LinearOptions& options, int threads);

/// Name of the solver that suits a matrix, by its size, symmetry and number of unknowns a row.
std::string_view suitable_solver(const SparseMatrix& matrix);

/// Hands every matrix to the solver that suits it.
std::unique_ptr<LinearSolver> make_automatic_solver(const LinearOptions& options, int threads);

}  // namespace winslow
