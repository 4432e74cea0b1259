#pragma once

#include "core/linear/linear_solver.h"
#include "core/linear/sparse_system.h"

namespace winslow {

/// Hands a matrix that is positive semidefinite by construction to a solver. Where round-off or
/// sizes too far apart spoil that, a growing share of each diagonal block's trace is added to its
/// diagonal until the solver takes it. `matrix` is changed accordingly.
/// Throws NotPositiveDefinite if even a share of one does not help.
void set_shifted_matrix(LinearSolver& solver, SparseMatrix& matrix);

}  // namespace winslow
