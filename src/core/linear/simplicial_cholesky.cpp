#if !defined(WINSLOW_HAS_CHOLMOD)
#include <Eigen/SparseCholesky>

#include "core/error.h"
#include "core/linear/factorisation.h"

namespace winslow {

namespace {

class SimplicialCholesky final : public Factorisation {
 public:
  std::string description() const override { return "Eigen simplicial Cholesky"; }

  void factorise(const SparseMatrix& matrix) override {
    if (matrix_.assign(matrix)) llt_.analyzePattern(matrix_.matrix());
    llt_.factorize(matrix_.matrix());
    if (llt_.info() != Eigen::Success) {
      throw NotPositiveDefinite("the matrix is not positive definite (sparse Cholesky)");
    }
  }

  void solve(std::span<const double> rhs, int columns, std::span<double> x) override {
    using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    const Eigen::Index n = matrix_.matrix().rows();
    const Eigen::MatrixXd b = Eigen::Map<const RowMajor>(rhs.data(), n, columns);
    const Eigen::MatrixXd solution = llt_.solve(b);
    if (!solution.allFinite()) {
      throw NumericError("the linear system is singular to working precision");
    }
    Eigen::Map<RowMajor>(x.data(), n, columns) = solution;
  }

 private:
  EigenMatrix matrix_{EigenMatrix::Part::lower};
  Eigen::SimplicialLLT<Eigen::SparseMatrix<double>> llt_;
};

}  // namespace

std::unique_ptr<Factorisation> make_cholesky() { return std::make_unique<SimplicialCholesky>(); }

}  // namespace winslow
#endif
