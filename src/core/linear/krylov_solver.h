#pragma once

#include <memory>

#include "core/linear/linear_solver.h"
#include "core/linear/preconditioner.h"

namespace winslow {

/// Restarted GMRES, preconditioned by an incomplete LU factorisation with threshold (ILUT).
std::unique_ptr<LinearSolver> make_gmres_solver(const LinearOptions& options, int threads);

}  // namespace winslow
