#include "core/linear/direct_solver.h"

#include <algorithm>
#include <vector>

#include "core/error.h"
#include "core/linear/factorisation.h"
#include "core/linear/krylov.h"
#include "core/linear/residual.h"

namespace winslow {

namespace {

class DirectSolver final : public LinearSolver {
 public:
  DirectSolver(const LinearOptions& options, int threads)
      : krylov_{options.tolerance, options.max_iterations, options.restart, threads} {}

  std::string_view name() const override { return "direct"; }
  std::string description() const override {
    return factor_ ? factor_->description() : "sparse factorisation";
  }
  void set_tolerance(double relative_residual) override { krylov_.tolerance = relative_residual; }

  void set_matrix(const SparseMatrix& matrix, bool keep) override {
    matrix_ = &matrix;
    if (keep && factorised_ && pattern_ == matrix.pattern && block_ == matrix.block &&
        symmetric_ == matrix.symmetric) {
      outdated_ = true;
      return;
    }
    factorise();
  }

  LinearResult solve(std::span<const double> rhs, int columns, std::span<double> x) override {
    if (matrix_->rows() == 0) return {1, 0};
    if (outdated_) {
      // A factorisation takes about as long as so many iterations with the old factor.
      constexpr int worthwhile = 12;
      KrylovOptions few = krylov_;
      few.max_iterations = std::min(few.max_iterations, worthwhile);
      const std::vector<double> guess(x.begin(), x.end());
      const LinearResult corrected = krylov_solve(
          *matrix_,
          [&](std::span<const double> r, std::span<double> z) { factor_->solve(r, 1, z); }, few,
          rhs, columns, x);
      // Slack for what round-off makes of the residual that the iteration updates.
      if (corrected.relative_residual <= 2 * krylov_.tolerance) return corrected;
      std::copy(guess.begin(), guess.end(), x.begin());
      factorise();
    }
    factor_->solve(rhs, columns, x);
    return {1, relative_residual(*matrix_, rhs, columns, x, krylov_.threads)};
  }

 private:
  void factorise() {
    factorised_ = false;
    outdated_ = false;
    if (!factor_ || symmetric_ != matrix_->symmetric || pattern_ != matrix_->pattern ||
        block_ != matrix_->block) {
      factor_ = matrix_->symmetric ? make_cholesky() : make_lu(matrix_->rows());
    }
    pattern_ = matrix_->pattern;
    block_ = matrix_->block;
    symmetric_ = matrix_->symmetric;
    if (matrix_->rows() > 0) factor_->factorise(*matrix_);
    factorised_ = true;
  }

  KrylovOptions krylov_;
  std::unique_ptr<Factorisation> factor_;
  std::shared_ptr<const SparsityPattern> pattern_;  // of the factor, as the two below
  int block_ = 0;
  bool symmetric_ = false;
  bool factorised_ = false;
  bool outdated_ = false;  // the factor is that of an earlier matrix
  const SparseMatrix* matrix_ = nullptr;
};

}  // namespace

std::unique_ptr<LinearSolver> make_direct_solver(const LinearOptions& options, int threads) {
  return std::make_unique<DirectSolver>(options, threads);
}

}  // namespace winslow
