#pragma once

#include <span>

#include "core/linear/linear_solver.h"
#include "core/linear/sparse_system.h"

namespace winslow {

/// Adds a share of each diagonal block's mean diagonal entry to its diagonal.
void shift_diagonal(SparseMatrix& matrix, double share);

/// Hands a matrix that is positive semidefinite by construction to a solver. Where round-off or
/// sizes too far apart spoil that, a growing share of each diagonal block's trace is added to its
/// diagonal until the solver takes it. `matrix` is changed accordingly.
/// Throws NotPositiveDefinite if even a share of one does not help.
void set_shifted_matrix(LinearSolver& solver, SparseMatrix& matrix);

/// The same, and solves for one right-hand side: an iterative solver finds out only then.
/// `solution` is written from zero on.
LinearResult solve_shifted(LinearSolver& solver, SparseMatrix& matrix, std::span<const double> rhs,
                           std::span<double> solution);

}  // namespace winslow
