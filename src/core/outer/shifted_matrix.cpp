#include "core/outer/shifted_matrix.h"

#include <algorithm>

#include "core/error.h"

namespace winslow {

void shift_diagonal(SparseMatrix& matrix, double share) {
  const auto n = static_cast<std::size_t>(matrix.block);
  for (const Index e : matrix.pattern->diagonal) {
    double* block = matrix.values.data() + n * n * static_cast<std::size_t>(e);
    double trace = 0;
    for (std::size_t i = 0; i < n; ++i) trace += block[i * n + i];
    for (std::size_t i = 0; i < n; ++i) block[i * n + i] += share * trace / static_cast<double>(n);
  }
}

namespace {

/// Calls `take` with a matrix whose diagonal grows until it no longer throws.
template <typename Take>
void until_taken(SparseMatrix& matrix, Take&& take) {
  constexpr double first = 1e-10, growth = 100;
  for (double share = first;; share *= growth) {
    try {
      take();
      return;
    } catch (const NotPositiveDefinite&) {
      if (share > 1) throw;
    }
    shift_diagonal(matrix, share);
  }
}

}  // namespace

void set_shifted_matrix(LinearSolver& solver, SparseMatrix& matrix) {
  until_taken(matrix, [&] { solver.set_matrix(matrix); });
}

LinearResult solve_shifted(LinearSolver& solver, SparseMatrix& matrix, std::span<const double> rhs,
                           std::span<double> solution) {
  LinearResult result;
  until_taken(matrix, [&] {
    std::fill(solution.begin(), solution.end(), 0.0);
    solver.set_matrix(matrix);
    result = solver.solve(rhs, 1, solution);
  });
  return result;
}

}  // namespace winslow
