#include "core/linear/gmres_solver.h"

#include <Eigen/IterativeLinearSolvers>
#include <unsupported/Eigen/IterativeSolvers>

#include "core/error.h"
#include "core/linear/eigen_matrix.h"
#include "core/linear/residual.h"

namespace winslow {

namespace {

class GmresSolver final : public LinearSolver {
 public:
  explicit GmresSolver(const LinearOptions& options) {
    gmres_.set_restart(options.restart);
    gmres_.setTolerance(options.tolerance);
    gmres_.setMaxIterations(options.max_iterations);
    gmres_.preconditioner().setDroptol(1e-3);
    gmres_.preconditioner().setFillfactor(10);
  }

  std::string_view name() const override { return "gmres"; }

  LinearResult solve(const SparseSystem& system, std::span<double> x) override {
    if (matrix_.assign(system)) {
      // Not analyzePattern: Eigen's ILUT would be asked for a status that it has not set yet.
      gmres_.compute(matrix_.matrix());
    } else {
      gmres_.factorize(matrix_.matrix());
    }
    if (gmres_.info() != Eigen::Success) {
      throw NumericError("the linear system is singular (incomplete LU failed)");
    }
    const Index n = system.pattern->rows();
    using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    Eigen::Map<RowMajor> solution(x.data(), n, system.columns);
    const Eigen::Map<const RowMajor> rhs(system.rhs.data(), n, system.columns);
    LinearResult result;
    for (int c = 0; c < system.columns; ++c) {
      const Eigen::VectorXd b = rhs.col(c);
      if (b.squaredNorm() == 0) {
        solution.col(c).setZero();
        continue;
      }
      const Eigen::VectorXd guess = solution.col(c);
      const Eigen::VectorXd y = gmres_.solveWithGuess(b, guess);
      if (!y.allFinite()) throw NumericError("GMRES broke down");
      solution.col(c) = y;
      result.iterations = std::max(result.iterations, static_cast<int>(gmres_.iterations()));
    }
    result.relative_residual = relative_residual(system, x);
    return result;
  }

 private:
  EigenMatrix matrix_;
  Eigen::GMRES<Eigen::SparseMatrix<double>, Eigen::IncompleteLUT<double>> gmres_;
};

}  // namespace

std::unique_ptr<LinearSolver> make_gmres_solver(const LinearOptions& options) {
  return std::make_unique<GmresSolver>(options);
}

}  // namespace winslow
