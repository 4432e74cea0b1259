#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/linear/sparse_system.h"

namespace winslow {

struct LinearOptions {
  std::string solver = "direct";  ///< one of linear_solver_names()
  /// Relative residual at which an iterative solver stops (gmres: preconditioned). The iteration is
  /// damped anyway, so a loose one costs no accuracy: the converged mesh is the same.
  double tolerance = 1e-3;
  int max_iterations = 200;  ///< Gauss-Seidel sweeps or Krylov iterations per solve
  int restart = 30;          ///< Krylov vectors before GMRES restarts

  bool operator==(const LinearOptions&) const = default;
};

struct LinearResult {
  int iterations = 0;            ///< 1 for a direct solve
  double relative_residual = 0;  ///< |B - A X| / |B|, worst right-hand side
};

/// Solves sparse systems that share a pattern. Implementations keep what depends on the pattern
/// alone (orderings, symbolic factorisations) from call to call.
class LinearSolver {
 public:
  virtual ~LinearSolver() = default;
  virtual std::string_view name() const = 0;
  /// Solves A X = B. x: #rows by columns, first guess on entry, solution on return.
  /// Throws NumericError for a singular matrix.
  virtual LinearResult solve(const SparseSystem& system, std::span<double> x) = 0;
};

/// "direct", "gmres", "point-implicit".
std::vector<std::string> linear_solver_names();
/// One line on each for help texts and tooltips.
std::string_view linear_solver_summary(std::string_view name);
/// Throws UsageError for an unknown name.
std::unique_ptr<LinearSolver> make_linear_solver(const LinearOptions& options);

}  // namespace winslow
