#include <Eigen/SparseLU>
#if defined(WINSLOW_HAS_KLU)
#include <Eigen/KLUSupport>
#endif
#if defined(WINSLOW_HAS_UMFPACK)
#include <Eigen/UmfPackSupport>
#endif

#include <new>

#include "core/error.h"
#include "core/linear/blas_memory.h"
#include "core/linear/eigen_matrix.h"
#include "core/linear/factorisation.h"

namespace winslow {

namespace {

using Matrix = Eigen::SparseMatrix<double>;

#if defined(WINSLOW_HAS_KLU)
/// The analysis, which does not fail on square matrices for any other reason, leaves nothing that
/// the factorisation takes for valid.
bool ran_out_of_memory(Eigen::KLU<Matrix>& lu) {
  const int status = lu.kluCommon().status;
  return status == KLU_OUT_OF_MEMORY || status == KLU_TOO_LARGE || status == KLU_INVALID;
}
#endif
#if defined(WINSLOW_HAS_UMFPACK)
/// The analysis, which leaves no other trace of its failure, does not fail on square matrices.
bool ran_out_of_memory(const Eigen::UmfPackLU<Matrix>& lu) {
  return lu.umfpackFactorizeReturncode() == UMFPACK_ERROR_out_of_memory ||
         lu.umfpackFactorizeReturncode() == UMFPACK_ERROR_invalid_Symbolic_object;
}
#endif
#if !defined(WINSLOW_HAS_KLU) && !defined(WINSLOW_HAS_UMFPACK)
bool ran_out_of_memory(const Eigen::SparseLU<Matrix>&) { return false; }  // it throws
#endif

template <typename Lu>
class LuFactorisation final : public Factorisation {
 public:
  explicit LuFactorisation(const char* name) : name_(name) {
#if defined(WINSLOW_HAS_UMFPACK)
    // No steps of iterative refinement: residuals are at round-off without.
    if constexpr (std::is_same_v<Lu, Eigen::UmfPackLU<Matrix>>) {
      lu_.umfpackControl()(UMFPACK_IRSTEP) = 0;
    }
#endif
  }

  std::string description() const override { return name_; }

  void factorise(const SparseMatrix& matrix) override {
    if (matrix_.assign(matrix)) lu_.analyzePattern(matrix_.matrix());
    lu_.factorize(matrix_.matrix());
    if (lu_.info() != Eigen::Success) {
      if (ran_out_of_memory(lu_)) throw std::bad_alloc();
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
  const char* name_;
  EigenMatrix matrix_{EigenMatrix::Part::all};
  Lu lu_;
};

}  // namespace

std::unique_ptr<Factorisation> make_lu([[maybe_unused]] Index rows) {
#if defined(WINSLOW_HAS_UMFPACK)
#if defined(WINSLOW_HAS_KLU)
  // Below, dense kernels do not pay for themselves.
  constexpr Index umfpack_limit = 8'000;
  if (rows < umfpack_limit || !blas_has_memory())
    return std::make_unique<LuFactorisation<Eigen::KLU<Matrix>>>("KLU sparse LU");
#endif
  return std::make_unique<LuFactorisation<Eigen::UmfPackLU<Matrix>>>("UMFPACK sparse LU");
#elif defined(WINSLOW_HAS_KLU)
  return std::make_unique<LuFactorisation<Eigen::KLU<Matrix>>>("KLU sparse LU");
#else
  return std::make_unique<LuFactorisation<Eigen::SparseLU<Matrix>>>("Eigen sparse LU");
#endif
}

}  // namespace winslow
