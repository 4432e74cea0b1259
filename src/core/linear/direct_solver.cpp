#include "core/linear/direct_solver.h"

#include <Eigen/SparseLU>
#if defined(WINSLOW_HAS_KLU)
#include <Eigen/KLUSupport>
#elif defined(WINSLOW_HAS_UMFPACK)
#include <Eigen/UmfPackSupport>
#endif

#include "core/error.h"
#include "core/linear/eigen_matrix.h"
#include "core/linear/residual.h"

namespace winslow {

namespace {

using Matrix = Eigen::SparseMatrix<double>;
#if defined(WINSLOW_HAS_KLU)
using Factorisation = Eigen::KLU<Matrix>;
constexpr std::string_view backend = "KLU";
#elif defined(WINSLOW_HAS_UMFPACK)
using Factorisation = Eigen::UmfPackLU<Matrix>;
constexpr std::string_view backend = "UMFPACK";
#else
using Factorisation = Eigen::SparseLU<Matrix>;
constexpr std::string_view backend = "Eigen SparseLU";
#endif

class DirectSolver final : public LinearSolver {
 public:
  std::string_view name() const override { return "direct"; }

  LinearResult solve(const SparseSystem& system, std::span<double> x) override {
    if (matrix_.assign(system)) lu_.analyzePattern(matrix_.matrix());
    lu_.factorize(matrix_.matrix());
    if (lu_.info() != Eigen::Success) {
      throw NumericError("the linear system is singular (sparse LU failed)");
    }
    const Index n = system.pattern->rows();
    using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    const Eigen::MatrixXd b = Eigen::Map<const RowMajor>(system.rhs.data(), n, system.columns);
    const Eigen::MatrixXd solution = lu_.solve(b);
    if (!solution.allFinite()) {
      throw NumericError("the linear system is singular to working precision");
    }
    Eigen::Map<RowMajor>(x.data(), n, system.columns) = solution;
    return {1, relative_residual(system, x)};
  }

 private:
  EigenMatrix matrix_;
  Factorisation lu_;
};

}  // namespace

std::unique_ptr<LinearSolver> make_direct_solver() { return std::make_unique<DirectSolver>(); }

std::string_view direct_solver_backend() { return backend; }

}  // namespace winslow
