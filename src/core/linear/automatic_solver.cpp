#include "core/linear/automatic_solver.h"

#include <cmath>

#include "core/error.h"

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
    if (hard_ != matrix.pattern) hard_.reset();
    const std::string_view suitable = hard_ ? direct : suitable_solver(matrix);
    if (!chosen_ || chosen_->name() != suitable) {
      options_.solver = suitable;
      chosen_ = make_linear_solver(options_, threads_);
    }
    matrix_ = &matrix;
    factorised_ = false;
    chosen_->set_matrix(matrix, keep);
  }

  /// Where an iteration fails, a factorisation knows: it solves, or says what the matrix is. Of
  /// large meshes in space it would take minutes and all memory: there the iteration has the word.
  LinearResult solve(std::span<const double> rhs, int columns, std::span<double> x) override {
    if (factorised_) return fallback_->solve(rhs, columns, x);
    if (chosen_->name() == direct) return chosen_->solve(rhs, columns, x);
    constexpr double usable = 10;  // tolerances
    try {
      const LinearResult result = chosen_->solve(rhs, columns, x);
      remember_if_hard(result);
      if (result.relative_residual <= usable * options_.tolerance || !can_factorise())
        return result;
    } catch (const NumericError&) {
      // Broken down, or not positive definite after all.
      if (!can_factorise()) throw;
    }
    if (!fallback_) {
      LinearOptions options = options_;
      options.solver = direct;
      fallback_ = make_linear_solver(options, threads_);
    }
    fallback_->set_matrix(*matrix_, false);
    factorised_ = true;
    return fallback_->solve(rhs, columns, x);
  }

 private:
  static constexpr std::string_view direct = "direct";

  bool can_factorise() const {
    constexpr Index limit_in_space = 30'000;
    return !is_in_space() || matrix_->rows() <= limit_in_space;
  }
  bool is_in_space() const { return matrix_->block == 3 || matrix_->in_space; }

  /// On stretched meshes multigrid takes many iterations, and a factorisation is the faster up to
  /// much larger ones; beyond that its memory stands against it. In the plane and on surfaces its
  /// work grows with the power 3/2 of the size, that of an iteration in proportion.
  void remember_if_hard(const LinearResult& result) {
    constexpr double many_in_space = 50, many_of_hundred_thousand = 100;
    const Index limit = is_in_space() ? 15'000 : 300'000;
    const double many =
        is_in_space() ? many_in_space : many_of_hundred_thousand * std::sqrt(matrix_->rows() / 1e5);
    if (result.iterations > many && matrix_->symmetric && matrix_->rows() <= limit)
      hard_ = matrix_->pattern;
  }

  LinearOptions options_;
  int threads_;
  const SparseMatrix* matrix_ = nullptr;
  std::shared_ptr<const SparsityPattern> hard_;  // of matrices that multigrid is slow on, if any
  std::unique_ptr<LinearSolver> fallback_;       // made when first needed
  bool factorised_ = false;                      // the fallback has the present matrix
  std::unique_ptr<LinearSolver> chosen_;
};

}  // namespace

std::string_view suitable_solver(const SparseMatrix& matrix) {
  // Unknowns up to which a factorisation is the faster, as measured by bench/linear_bench. Three
  // unknowns a row are those of a mesh in space, where factors fill in much more.
  constexpr Index cholesky_limit = 10'000, cholesky_limit_in_space = 5'000;
  constexpr Index lu_limit = 400'000, lu_limit_in_space = 1'000;
  if (!matrix.symmetric)
    return matrix.rows() <= (matrix.in_space ? lu_limit_in_space : lu_limit) ? "direct" : "gmres";
  const Index limit = matrix.block < 3 ? cholesky_limit : cholesky_limit_in_space;
  return matrix.rows() <= limit ? "direct" : "multigrid";
}

std::unique_ptr<LinearSolver> make_automatic_solver(const LinearOptions& options, int threads) {
  return std::make_unique<AutomaticSolver>(options, threads);
}

}  // namespace winslow
