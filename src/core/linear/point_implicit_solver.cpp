#include "core/linear/point_implicit_solver.h"

#include "core/error.h"
#include "core/linear/residual.h"

namespace winslow {

namespace {

/// Relaxes one row for all right-hand sides.
void relax(const SparseSystem& system, std::size_t row, std::span<double> x) {
  const SparsityPattern& p = *system.pattern;
  const auto columns = static_cast<std::size_t>(system.columns);
  const auto diagonal = static_cast<std::size_t>(p.diagonal[row]);
  const double d = system.values[diagonal];
  if (d == 0) throw NumericError("the linear system has a zero on its diagonal");
  for (std::size_t c = 0; c < columns; ++c) {
    double sum = system.rhs[row * columns + c];
    for (auto e = static_cast<std::size_t>(p.offsets[row]);
         e < static_cast<std::size_t>(p.offsets[row + 1]); ++e) {
      if (e != diagonal) {
        sum -= system.values[e] * x[static_cast<std::size_t>(p.columns[e]) * columns + c];
      }
    }
    x[row * columns + c] = sum / d;
  }
}

class PointImplicitSolver final : public LinearSolver {
 public:
  explicit PointImplicitSolver(const LinearOptions& options) : options_(options) {}

  std::string_view name() const override { return "point-implicit"; }

  LinearResult solve(const SparseSystem& system, std::span<double> x) override {
    const auto rows = static_cast<std::size_t>(system.pattern->rows());
    LinearResult result;
    result.relative_residual = relative_residual(system, x);
    while (result.iterations < options_.max_iterations &&
           result.relative_residual > options_.tolerance) {
      const bool forward = result.iterations % 2 == 0;
      for (std::size_t i = 0; i < rows; ++i) relax(system, forward ? i : rows - 1 - i, x);
      ++result.iterations;
      // The check costs as much as a sweep.
      if (result.iterations % check_every == 0 || result.iterations == options_.max_iterations) {
        result.relative_residual = relative_residual(system, x);
      }
    }
    return result;
  }

 private:
  static constexpr int check_every = 10;
  LinearOptions options_;
};

}  // namespace

std::unique_ptr<LinearSolver> make_point_implicit_solver(const LinearOptions& options) {
  return std::make_unique<PointImplicitSolver>(options);
}

}  // namespace winslow
