#include <Eigen/SparseLU>
#if defined(WINSLOW_HAS_KLU)
#include <Eigen/KLUSupport>
#elif defined(WINSLOW_HAS_UMFPACK)
#include <Eigen/UmfPackSupport>
#endif

#include "core/error.h"
#include "core/linear/eigen_matrix.h"
#include "core/linear/factorisation.h"

namespace winslow {

namespace {

using Matrix = Eigen::SparseMatrix<double>;
#if defined(WINSLOW_HAS_KLU)
using Lu = Eigen::KLU<Matrix>;
constexpr const char* backend = "KLU sparse LU";
#elif defined(WINSLOW_HAS_UMFPACK)
using Lu = Eigen::UmfPackLU<Matrix>;
constexpr const char* backend = "UMFPACK sparse LU";
#else
using Lu = Eigen::SparseLU<Matrix>;
constexpr const char* backend = "Eigen sparse LU";
#endif

class LuFactorisation final : public Factorisation {
 public:
  std::string description() const override { return backend; }

  void factorise(const SparseMatrix& matrix) override {
    if (matrix_.assign(matrix)) lu_.analyzePattern(matrix_.matrix());
    lu_.factorize(matrix_.matrix());
    if (lu_.info() != Eigen::Success) {
      throw NumericError("the linear system is singular (sparse LU failed)");
    }
  }

  void solve(std::span<const double> rhs, int columns, std::span<double> x) override {
    using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    const Eigen::Index n = matrix_.matrix().rows();
    const Eigen::MatrixXd b = Eigen::Map<const RowMajor>(rhs.data(), n, columns);
    const Eigen::MatrixXd solution = lu_.solve(b);
    if (!solution.allFinite()) {
      throw NumericError("the linear system is singular to working precision");
    }
    Eigen::Map<RowMajor>(x.data(), n, columns) = solution;
  }

 private:
  EigenMatrix matrix_{EigenMatrix::Part::all};
  Lu lu_;
};

}  // namespace

std::unique_ptr<Factorisation> make_lu() { return std::make_unique<LuFactorisation>(); }

}  // namespace winslow
