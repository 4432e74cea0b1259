#include "core/outer/newton_step.h"

#include <cmath>

#include "core/error.h"

namespace winslow {

double first_valid_step(const SmoothingProblem& problem, std::span<const double> direction,
                        double longest, const Coordinates& x) {
  constexpr double margin = 0.9;
  Coordinates full = x;
  problem.advance(direction, 1, full);
  return std::min(longest, margin * problem.largest_valid_step(x, full, longest / margin));
}

double shorter_step(double t, double slope, double rise) {
  const double shorter = std::isfinite(rise) && rise > 0 ? 0.5 * slope * t * t / rise : 0;
  return std::clamp(shorter, 0.1 * t, 0.5 * t);
}

double longer_step(double slope, double change) {
  const double curvature = change + slope;  // half of it
  return curvature > 0 ? slope / (2 * curvature) : 1;
}

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

/// Calls attempt() with a growing diagonal of the matrix until it no longer throws.
template <typename Attempt>
void until_positive_definite(SparseMatrix& matrix, Attempt&& attempt) {
  constexpr double first = 1e-10, growth = 100;
  for (double share = first;; share *= growth) {
    try {
      attempt();
      return;
    } catch (const NotPositiveDefinite&) {
      if (share > 1) throw;
    }
    shift_diagonal(matrix, share);
  }
}

}  // namespace

void set_shifted_matrix(LinearSolver& solver, SparseMatrix& matrix) {
  until_positive_definite(matrix, [&] { solver.set_matrix(matrix); });
}

LinearResult solve_shifted(LinearSolver& solver, SparseMatrix& matrix, std::span<const double> rhs,
                           std::span<double> solution) {
  LinearResult result;
  until_positive_definite(matrix, [&] {
    std::fill(solution.begin(), solution.end(), 0.0);
    solver.set_matrix(matrix);
    result = solver.solve(rhs, 1, solution);
  });
  return result;
}

}  // namespace winslow
