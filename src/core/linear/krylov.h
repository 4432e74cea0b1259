#pragma once

#include <functional>

#include "core/linear/linear_solver.h"

/// Krylov methods for one right-hand side, for iterative solvers and for direct solvers with the
/// factor of an earlier matrix.
namespace winslow {

/// z = M^-1 r with a fixed linear M close to A; symmetric and positive definite for conjugate
/// gradients. r and z are different arrays.
using ApplyPreconditioner = std::function<void(std::span<const double> r, std::span<double> z)>;

/// Lets a caller stop the iterative linear solvers below it, however deep they run and however many
/// iterations they may make:
///
///     const winslow::LinearCheckpoint checkpoint([&] {
///       if (cancelled) throw winslow::Cancelled();
///     });
///     solver->solve(rhs, 1, x);  // throws Cancelled between two iterations
///
/// During its lifetime the solvers that its thread calls ask before every iteration. An inner
/// checkpoint replaces the outer one for its lifetime. x then holds no solution; the solver can go
/// on with set_matrix().
class LinearCheckpoint {
 public:
  /// ask: throws to end the solve; empty: never asks.
  explicit LinearCheckpoint(std::function<void()> ask);
  ~LinearCheckpoint();
  LinearCheckpoint(const LinearCheckpoint&) = delete;
  LinearCheckpoint& operator=(const LinearCheckpoint&) = delete;

  /// What iterative solvers call before an iteration.
  static void pass();

 private:
  std::function<void()> ask_;
  const LinearCheckpoint* outer_;
};

struct KrylovOptions {
  double tolerance = 1e-3;  ///< stop at |b - A x| <= tolerance |b|
  int max_iterations = 200;
  int restart = 30;  ///< of GMRES
  int threads = 0;   ///< 0 for all cores; the result does not depend on it
};

/// Preconditioned conjugate gradients on a symmetric matrix; x: initial guess on entry, solution on
/// return. Returns the true residual. Throws NotPositiveDefinite on a direction of negative
/// curvature, NumericError if a number is not finite.
LinearResult conjugate_gradients(const SparseMatrix& matrix,
                                 const ApplyPreconditioner& precondition,
                                 const KrylovOptions& options, std::span<const double> b,
                                 std::span<double> x);

/// Restarted GMRES, preconditioned from the right so that the residual it watches is the true one
/// (Y. Saad, Iterative Methods for Sparse Linear Systems, 2nd edition, section 9.3.2). As above.
LinearResult gmres(const SparseMatrix& matrix, const ApplyPreconditioner& precondition,
                   const KrylovOptions& options, std::span<const double> b, std::span<double> x);

/// Solves for every right-hand side by one of the two, depending on the symmetry of the matrix. rhs
/// and x are stored by rows as in LinearSolver::solve.
LinearResult krylov_solve(const SparseMatrix& matrix, const ApplyPreconditioner& precondition,
                          const KrylovOptions& options, std::span<const double> rhs, int columns,
                          std::span<double> x);

}  // namespace winslow
