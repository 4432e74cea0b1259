#pragma once

#include <span>
#include <string>

#include "core/linear/sparse_system.h"

/// Options of the linear solver:
///
///     winslow::SmoothCommand smooth;
///     smooth.smooth.linear.solver = "direct";  // one of winslow::linear_solver_names()
namespace winslow {

struct LinearOptions {
  std::string solver = "automatic";  ///< one of linear_solver_names()
  /// Relative residual at which an iterative solver stops. The outer iteration corrects the
  /// remaining error, so a loose tolerance does not change the converged mesh. Newton's method on
  /// the energy chooses its own tolerance, between 1e-2 and 1e-6 (or this one, if it is tighter).
  double tolerance = 1e-3;
  int max_iterations = 200;  ///< Gauss-Seidel sweeps or Krylov iterations per solve
  int restart = 30;          ///< Krylov vectors before GMRES restarts

  bool operator==(const LinearOptions&) const = default;
};

struct LinearResult {
  int iterations = 0;            ///< 1 for a direct solve; else of the worst right-hand side
  double relative_residual = 0;  ///< |B - A X| / |B|, worst right-hand side

  /// Merges the result for another right-hand side: keeps the larger of each value. NaN counts as
  /// the largest.
  void worsen(const LinearResult& other);
};

/// Solves A X = B. Call set_matrix() first, then solve() any number of times.
class LinearSolver {
 public:
  virtual ~LinearSolver() = default;
  /// The requested solver: one of linear_solver_names().
  virtual std::string_view name() const = 0;
  /// The method actually used for the last matrix, for reports: "KLU sparse LU".
  virtual std::string description() const = 0;

  /// Factorises, or builds the preconditioner. Data that depend only on the pattern and the block
  /// size (orderings, symbolic factorisations) are kept as long as the pattern object stays the
  /// same. The solver refers to `matrix` until the next call.
  ///
  /// keep: keep the factor or preconditioner of the earlier matrix, if there is one for this
  /// pattern and block size; solve() then applies it as a preconditioner for conjugate gradients
  /// (symmetric) or GMRES on the new matrix.
  ///
  /// Throws NumericError for a singular matrix, NotPositiveDefinite for a symmetric one that is not
  /// positive definite, UsageError for one that this solver does not support. After an exception,
  /// call set_matrix() again before solve().
  virtual void set_matrix(const SparseMatrix& matrix, bool keep = false) = 0;

  /// rhs, x: #scalar rows by columns, row after row; x holds the first guess on entry, the solution
  /// on return. The result is the same at any number of threads. An iterative solver that runs out
  /// of iterations returns what it has: see LinearResult::relative_residual.
  /// Throws NumericError or NotPositiveDefinite for problems that appear only here.
  virtual LinearResult solve(std::span<const double> rhs, int columns, std::span<double> x) = 0;

  /// Relative residual at which later solves stop, replaces LinearOptions::tolerance. Has no effect
  /// if the factors are those of the matrix itself: these solve exactly.
  virtual void set_tolerance(double relative_residual) = 0;

  /// Adds the memory that it keeps from call to call.
  virtual void count(MemoryUse& /*use*/) const {}
};

/// "automatic", "direct", "cg", "multigrid", "gmres", "point-implicit".
std::vector<std::string> linear_solver_names();
/// One line on each for help texts and tooltips.
std::string_view linear_solver_summary(std::string_view name);
/// True for solvers that require symmetric matrices.
bool linear_solver_needs_symmetry(std::string_view name);
/// Throws UsageError for an unknown name. threads: 0 for all cores.
std::unique_ptr<LinearSolver> make_linear_solver(const LinearOptions& options, int threads = 0);

}  // namespace winslow
