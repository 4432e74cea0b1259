#include "core/outer/shifted_matrix.h"

#include "core/error.h"

namespace winslow {

namespace {

void shift_diagonal(SparseMatrix& matrix, double share) {
  const auto n = static_cast<std::size_t>(matrix.block);
  for (const Index e : matrix.pattern->diagonal) {
    double* block = matrix.values.data() + n * n * static_cast<std::size_t>(e);
    double trace = 0;
    for (std::size_t i = 0; i < n; ++i) trace += block[i * n + i];
    for (std::size_t i = 0; i < n; ++i) block[i * n + i] += share * trace / static_cast<double>(n);
  }
}

}  // namespace

void set_shifted_matrix(LinearSolver& solver, SparseMatrix& matrix) {
  constexpr double first = 1e-10, growth = 100;
  for (double share = first;; share *= growth) {
    try {
      solver.set_matrix(matrix);
      return;
    } catch (const NotPositiveDefinite&) {
      if (share > 1) throw;
    }
    shift_diagonal(matrix, share);
  }
}

}  // namespace winslow
