#include "core/linear/krylov_solver.h"

#include <algorithm>
#include <string>
#include <vector>

#include "core/error.h"
#include "core/linear/incomplete_cholesky.h"
#include "core/linear/incomplete_lu.h"
#include "core/linear/krylov.h"
#include "core/linear/multigrid.h"
#include "core/linear/reordered_matrix.h"

namespace winslow {

namespace {

/// A Krylov method on a copy of the matrix in an order that is good to caches.
class KrylovSolver final : public LinearSolver {
 public:
  enum class Method { conjugate_gradients, gmres };

  KrylovSolver(std::string_view name, Method method, std::unique_ptr<Preconditioner> preconditioner,
               const LinearOptions& options, int threads)
      : name_(name),
        method_(method),
        preconditioner_(std::move(preconditioner)),
        krylov_{options.tolerance, options.max_iterations, options.restart, threads} {}

  std::string_view name() const override { return name_; }
  std::string description() const override {
    return (method_ == Method::gmres ? "GMRES, " : "CG, ") + preconditioner_->description();
  }
  void set_tolerance(double relative_residual) override { krylov_.tolerance = relative_residual; }

  void set_matrix(const SparseMatrix& matrix, bool keep) override {
    if (method_ == Method::conjugate_gradients && !matrix.symmetric) {
      throw UsageError("the linear solver '" + std::string(name_) +
                       "' takes symmetric matrices only; use automatic, direct, gmres or "
                       "point-implicit for this one");
    }
    keep = keep && built_ && pattern_ == matrix.pattern && block_ == matrix.block;
    if (!keep) built_ = false;
    pattern_ = matrix.pattern;
    block_ = matrix.block;
    if (matrix.rows() > 0) {
      matrix_.assign(matrix, krylov_.threads);
      if (!keep) preconditioner_->build(matrix_.matrix());
    }
    built_ = true;
  }

  LinearResult solve(std::span<const double> rhs, int columns, std::span<double> x) override {
    LinearResult result;
    if (rhs.empty()) return result;
    const std::size_t n = rhs.size() / static_cast<std::size_t>(columns);
    std::vector<double> b(n), y(n);
    const auto solve_one = method_ == Method::gmres ? gmres : conjugate_gradients;
    for (int c = 0; c < columns; ++c) {
      matrix_.gather(rhs, columns, c, b);
      matrix_.gather(x, columns, c, y);
      const LinearResult one = solve_one(
          matrix_.matrix(),
          [&](std::span<const double> r, std::span<double> z) { preconditioner_->apply(r, z); },
          krylov_, b, y);
      matrix_.scatter(y, columns, c, x);
      result.worsen(one);
    }
    return result;
  }

 private:
  std::string_view name_;
  Method method_;
  std::unique_ptr<Preconditioner> preconditioner_;
  KrylovOptions krylov_;
  ReorderedMatrix matrix_;
  std::shared_ptr<const SparsityPattern> pattern_;  // of the preconditioner
  int block_ = 0;
  bool built_ = false;
};

}  // namespace

std::unique_ptr<LinearSolver> make_cg_solver(const LinearOptions& options, int threads) {
  return std::make_unique<KrylovSolver>("cg", KrylovSolver::Method::conjugate_gradients,
                                        make_incomplete_cholesky(threads), options, threads);
}

std::unique_ptr<LinearSolver> make_multigrid_solver(const LinearOptions& options, int threads) {
  return std::make_unique<KrylovSolver>("multigrid", KrylovSolver::Method::conjugate_gradients,
                                        make_multigrid(threads), options, threads);
}

std::unique_ptr<LinearSolver> make_gmres_solver(const LinearOptions& options, int threads) {
  return std::make_unique<KrylovSolver>("gmres", KrylovSolver::Method::gmres, make_incomplete_lu(),
                                        options, threads);
}

}  // namespace winslow
