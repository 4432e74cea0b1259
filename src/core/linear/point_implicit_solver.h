#pragma once

#include <memory>

#include "core/linear/linear_solver.h"

namespace winslow {

/// Gauss-Seidel sweeps, alternately forward and backward: the simple solver that AIAA 2009-1362
/// mentions first.
std::unique_ptr<LinearSolver> make_point_implicit_solver(const LinearOptions& options);

}  // namespace winslow
