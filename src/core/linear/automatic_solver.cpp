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
  constexpr Index direct_limit = 400'000;  // unknowns
  return matrix.symmetric || matrix.rows() <= direct_limit ? "direct" : "gmres";
}

std::unique_ptr<LinearSolver> make_automatic_solver(const LinearOptions& options, int threads) {
  return std::make_unique<AutomaticSolver>(options, threads);
}

}  // namespace winslow
