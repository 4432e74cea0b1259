#pragma once

#include <span>
#include <string>
#include <string_view>

#include "core/linear/sparse_system.h"

/// The choice of a linear solver, as options have it:
///
///     winslow::SmoothCommand smooth;
///     smooth.smooth.linear.solver = "direct";  // one of winslow::linear_solver_names()
namespace winslow {

struct LinearOptions {
  std::string solver = "automatic";  ///< one of linear_solver_names()
  /// Relative residual at which an iterative solver stops. The outer iteration corrects what is
  /// left, so a loose one costs no accuracy: the converged mesh is the same. Newton's method on the
  /// energy chooses its own, between 1e-2 and 1e-6 (or this one, if it is tighter still).
  double tolerance = 1e-3;
  int max_iterations = 200;  ///< Gauss-Seidel sweeps or Krylov iterations per solve
  int restart = 30;          ///< Krylov vectors before GMRES restarts

  bool operator==(const LinearOptions&) const = default;
};

struct LinearResult {
  int iterations = 0;            ///< 1 for a direct solve; else of the worst right-hand side
  double relative_residual = 0;  ///< |B - A X| / |B|, worst right-hand side

  /// Takes over the worse of each, from another right-hand side. A NaN is the worst.
  void worsen(const LinearResult& other);
};

/// Solves A X = B. First set_matrix, then solve as often as there are right-hand sides.
class LinearSolver {
 public:
  virtual ~LinearSolver() = default;
  /// As asked for: one of linear_solver_names().
  virtual std::string_view name() const = 0;
  /// What is used in fact for the last matrix, for reports: "KLU sparse LU".
  virtual std::string description() const = 0;

  /// Factorises, or builds the preconditioner. What depends on the pattern and the block size alone
  /// (orderings, symbolic factorisations) is kept for as long as the pattern object stays the same.
  /// `matrix` is referred to until the next call.
  ///
  /// keep: leave the factor or preconditioner of the earlier matrix as it is, provided that there
  /// is one for this pattern and block size; solve() then corrects it by conjugate gradients
  /// (symmetric) or GMRES on the new matrix.
  ///
  /// Throws NumericError for a singular matrix, NotPositiveDefinite for a symmetric one that is not
  /// positive definite, UsageError for one that this solver does not take. After that it wants
  /// another matrix before the next solve.
  virtual void set_matrix(const SparseMatrix& matrix, bool keep = false) = 0;

  /// rhs, x: #scalar rows by columns, row after row; x holds the first guess on entry, the solution
  /// on return. The result is the same at any number of threads. An iterative solver that runs out
  /// of iterations returns what it has: see LinearResult::relative_residual.
  /// Throws NumericError or NotPositiveDefinite for what only shows here.
  virtual LinearResult solve(std::span<const double> rhs, int columns, std::span<double> x) = 0;

  /// Relative residual at which later solves stop, in place of LinearOptions::tolerance. Factors
  /// that belong to the matrix itself solve exactly whatever it is.
  virtual void set_tolerance(double relative_residual) = 0;
};

/// "automatic", "direct", "cg", "multigrid", "gmres", "point-implicit".
std::vector<std::string> linear_solver_names();
/// One line on each for help texts and tooltips.
std::string_view linear_solver_summary(std::string_view name);
/// True for those that take symmetric matrices only.
bool linear_solver_needs_symmetry(std::string_view name);
/// Throws UsageError for an unknown name. threads: 0 for all cores.
std::unique_ptr<LinearSolver> make_linear_solver(const LinearOptions& options, int threads = 0);

}  // namespace winslow
