#pragma once

#include <span>

#include "core/linear/sparse_system.h"

namespace winslow {

/// Number of threads for a loop over about `numbers` numbers, at most `threads`: waking threads
/// takes as long as thirty thousand multiplications. No result depends on it (see parallel_for).
inline int worthwhile(int threads, std::size_t numbers) {
  constexpr std::size_t least = 30'000;
  return numbers < least ? 1 : threads;
}

/// Calls solve_one(b, x) for each of several right-hand sides, stored by rows, on contiguous
/// copies. x is the initial guess on entry and the solution on return.
template <typename SolveOne>
void for_each_column(std::span<const double> rhs, int columns, std::span<double> x,
                     SolveOne&& solve_one) {
  if (columns == 1) {
    solve_one(rhs, x);
    return;
  }
  const auto stride = static_cast<std::size_t>(columns);
  std::vector<double> b(rhs.size() / stride), y(b.size());
  for (std::size_t c = 0; c < stride; ++c) {
    for (std::size_t i = 0; i < b.size(); ++i) {
      b[i] = rhs[i * stride + c];
      y[i] = x[i * stride + c];
    }
    solve_one(std::span<const double>(b), std::span<double>(y));
    for (std::size_t i = 0; i < b.size(); ++i) x[i * stride + c] = y[i];
  }
}

/// Threaded operations on long vectors and sparse matrices. Sums are taken over blocks of fixed
/// size and in order, so that no result depends on the number of threads (0: all cores).

double dot(std::span<const double> a, std::span<const double> b, int threads);

/// y += factor x.
void add_scaled(double factor, std::span<const double> x, std::span<double> y, int threads);

/// y = x + factor y.
void scale_and_add(double factor, std::span<const double> x, std::span<double> y, int threads);

/// x += step p and r -= step q, as in conjugate gradients. Returns r . r.
double advance(double step, std::span<const double> p, std::span<const double> q,
               std::span<double> x, std::span<double> r, int threads);

/// y = A x for one right-hand side. Returns x . y.
double multiply(const SparseMatrix& a, std::span<const double> x, std::span<double> y, int threads);

/// r = b - A x for one right-hand side. Returns r . r.
double defect(const SparseMatrix& a, std::span<const double> b, std::span<const double> x,
              std::span<double> r, int threads);

/// |B - A X| / |B| in the Euclidean norm, worst right-hand side; 0 if B and the residual are zero.
/// rhs, x: #scalar rows by columns, row after row. NaN if x is not finite. threads: 0 for all
/// cores.
double relative_residual(const SparseMatrix& matrix, std::span<const double> rhs, int columns,
                         std::span<const double> x, int threads = 1);

}  // namespace winslow
