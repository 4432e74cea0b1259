#pragma once

#include <memory>

#include "core/linear/linear_solver.h"

namespace winslow {

/// Gauss-Seidel sweeps over the rows of blocks, alternately forward and backward: the simple solver
/// that AIAA 2009-1362 mentions first. There is nothing of a matrix that it could keep.
std::unique_ptr<LinearSolver> make_point_implicit_solver(const LinearOptions& options, int threads);

}  // namespace winslow
