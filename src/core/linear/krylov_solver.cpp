#include "core/linear/krylov_solver.h"

#include "core/error.h"
#include "core/linear/incomplete_lu.h"
#include "core/linear/krylov.h"

namespace winslow {

namespace {

class KrylovSolver final : public LinearSolver {
 public:
  KrylovSolver(std::string_view name, std::unique_ptr<Preconditioner> preconditioner,
               const LinearOptions& options, int threads)
      : name_(name),
        preconditioner_(std::move(preconditioner)),
        krylov_{options.tolerance, options.max_iterations, options.restart, threads} {}

  std::string_view name() const override { return name_; }
  std::string description() const override { return "GMRES, " + preconditioner_->description(); }
  void set_tolerance(double relative_residual) override { krylov_.tolerance = relative_residual; }

  void set_matrix(const SparseMatrix& matrix, bool keep) override {
    matrix_ = matrix;
    matrix_.symmetric = false;  // the incomplete LU factors of a symmetric matrix are not
    if (keep && built_ && pattern_ == matrix.pattern && block_ == matrix.block) return;
    built_ = false;
    pattern_ = matrix.pattern;
    block_ = matrix.block;
    if (matrix.rows() > 0) preconditioner_->build(matrix);
    built_ = true;
  }

  LinearResult solve(std::span<const double> rhs, int columns, std::span<double> x) override {
    if (matrix_.rows() == 0) return {};
    return krylov_solve(
        matrix_,
        [&](std::span<const double> r, std::span<double> z) { preconditioner_->apply(r, z); },
        krylov_, rhs, columns, x);
  }

 private:
  std::string_view name_;
  std::unique_ptr<Preconditioner> preconditioner_;
  KrylovOptions krylov_;
  SparseMatrix matrix_;
  std::shared_ptr<const SparsityPattern> pattern_;  // of the preconditioner
  int block_ = 0;
  bool built_ = false;
};

}  // namespace

std::unique_ptr<LinearSolver> make_gmres_solver(const LinearOptions& options, int threads) {
  return std::make_unique<KrylovSolver>("gmres", make_incomplete_lu(), options, threads);
}

}  // namespace winslow
