#include "core/linear/point_implicit_solver.h"

#include <vector>

#include "core/error.h"
#include "core/linear/blocks.h"
#include "core/linear/residual.h"

namespace winslow {

namespace {

/// Inverses of the blocks on the diagonal, one after the other.
template <int B>
std::vector<double> inverse_diagonal(const SparseMatrix& matrix) {
  std::vector<double> inverse(at(matrix.pattern->rows()) * B * B);
  for (std::size_t i = 0; i < at(matrix.pattern->rows()); ++i) {
    const Eigen::Map<const Block<double, B>> d(
        &matrix.values[at(matrix.pattern->diagonal[i]) * B * B]);
    if (d.determinant() == 0) throw NumericError("the linear system has a zero on its diagonal");
    Eigen::Map<Block<double, B>> target(&inverse[i * B * B]);
    target = d.inverse();
  }
  return inverse;
}

class PointImplicitSolver final : public LinearSolver {
 public:
  PointImplicitSolver(const LinearOptions& options, int threads)
      : tolerance_(options.tolerance), max_iterations_(options.max_iterations), threads_(threads) {}

  std::string_view name() const override { return "point-implicit"; }
  std::string description() const override { return "Gauss-Seidel sweeps"; }
  void set_tolerance(double relative_residual) override { tolerance_ = relative_residual; }

  void set_matrix(const SparseMatrix& matrix, bool) override {
    matrix_ = &matrix;
    inverse_.clear();
    if (matrix.rows() == 0) return;
    inverse_ =
        with_block(matrix.block, [&](auto size) { return inverse_diagonal<size()>(matrix); });
  }

  LinearResult solve(std::span<const double> rhs, int columns, std::span<double> x) override {
    LinearResult result;
    if (matrix_->rows() == 0) return result;
    const auto residual = [&] { return relative_residual(*matrix_, rhs, columns, x, threads_); };
    result.relative_residual = residual();
    while (result.iterations < max_iterations_ && result.relative_residual > tolerance_) {
      const bool forward = result.iterations % 2 == 0;
      with_block(matrix_->block, [&](auto size) { sweep<size()>(rhs, columns, x, forward); });
      ++result.iterations;
      // The check costs as much as a sweep.
      if (result.iterations % check_every == 0 || result.iterations == max_iterations_) {
        result.relative_residual = residual();
      }
    }
    return result;
  }

 private:
  template <int B>
  void sweep(std::span<const double> rhs, int columns, std::span<double> x, bool forward) {
    const auto rows = at(matrix_->pattern->rows());
    for (std::size_t i = 0; i < rows; ++i) {
      relax<B>(rhs, at(columns), x, forward ? i : rows - 1 - i);
    }
  }

  /// Solves one row of blocks for all right-hand sides.
  template <int B>
  void relax(std::span<const double> rhs, std::size_t columns, std::span<double> x,
             std::size_t row) {
    const SparsityPattern& p = *matrix_->pattern;
    for (std::size_t k = 0; k < columns; ++k) {
      double sum[B];
      for (std::size_t r = 0; r < B; ++r) sum[r] = rhs[(row * B + r) * columns + k];
      for (auto e = at(p.offsets[row]); e < at(p.offsets[row + 1]); ++e) {
        if (e == at(p.diagonal[row])) continue;
        double other[B];
        for (std::size_t c = 0; c < B; ++c) other[c] = x[(at(p.columns[e]) * B + c) * columns + k];
        multiply_subtract<B>(&matrix_->values[e * B * B], other, sum);
      }
      double solution[B];
      multiply<B>(&inverse_[row * B * B], sum, solution);
      for (std::size_t r = 0; r < B; ++r) x[(row * B + r) * columns + k] = solution[r];
    }
  }

  static constexpr int check_every = 10;
  double tolerance_;
  int max_iterations_;
  int threads_;
  const SparseMatrix* matrix_ = nullptr;
  std::vector<double> inverse_;
};

}  // namespace

std::unique_ptr<LinearSolver> make_point_implicit_solver(const LinearOptions& options,
                                                         int threads) {
  return std::make_unique<PointImplicitSolver>(options, threads);
}

}  // namespace winslow
