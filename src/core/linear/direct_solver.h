#pragma once

#include <memory>

#include "core/linear/linear_solver.h"

namespace winslow {

/// Sparse LU: UMFPACK or KLU where the build has them, else Eigen's. The symbolic factorisation is
/// kept for as long as the pattern stays.
std::unique_ptr<LinearSolver> make_direct_solver();

/// "UMFPACK", "KLU" or "Eigen SparseLU": what make_direct_solver uses.
std::string_view direct_solver_backend();

}  // namespace winslow
