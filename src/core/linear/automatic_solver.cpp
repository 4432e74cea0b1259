#include "core/linear/automatic_solver.h"

namespace winslow {

namespace {

class AutomaticSolver final : public LinearSolver {
 public:
  AutomaticSolver(const LinearOptions& options, int threads)
      : options_(options), threads_(threads) {}

  std::string_view name() const override { return "automatic"; }
  std::string description() const override {
    return chosen_ ? chosen_->description() : "chosen by the matrix";
  }
  void set_tolerance(double relative_residual) override {
    options_.tolerance = relative_residual;
    if (chosen_) chosen_->set_tolerance(relative_residual);
  }

  void set_matrix(const SparseMatrix& matrix, bool keep) override {
    const std::string_view suitable = suitable_solver(matrix);
    if (!chosen_ || chosen_->name() != suitable) {
      options_.solver = suitable;
      chosen_ = make_linear_solver(options_, threads_);
    }
    chosen_->set_matrix(matrix, keep);
  }

  LinearResult solve(std::span<const double> rhs, int columns, std::span<double> x) override {
    return chosen_->solve(rhs, columns, x);
  }

 private:
  LinearOptions options_;
  int threads_;
  std::unique_ptr<LinearSolver> chosen_;
};

}  // namespace

std::string_view suitable_solver(const SparseMatrix& matrix) {
  // Unknowns up to which a factorisation is the faster, as measured by bench/linear_bench. Three
  // unknowns a row are those of a mesh in space, where factors fill in much more.
  constexpr Index cholesky_limit = 20'000, cholesky_limit_in_space = 5'000, lu_limit = 400'000;
  if (!matrix.symmetric) return matrix.rows() <= lu_limit ? "direct" : "gmres";
  const Index limit = matrix.block < 3 ? cholesky_limit : cholesky_limit_in_space;
  return matrix.rows() <= limit ? "direct" : "multigrid";
}

std::unique_ptr<LinearSolver> make_automatic_solver(const LinearOptions& options, int threads) {
  return std::make_unique<AutomaticSolver>(options, threads);
}

}  // namespace winslow
