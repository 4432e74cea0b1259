#pragma once

#include <memory>

#include "core/linear/linear_solver.h"

namespace winslow {

/// Name of the solver that suits a matrix, by its size, symmetry and number of unknowns a row.
std::string_view suitable_solver(const SparseMatrix& matrix);

/// Hands every matrix to the solver that suits it.
std::unique_ptr<LinearSolver> make_automatic_solver(const LinearOptions& options, int threads);

}  // namespace winslow
