#include "core/linear/factorisation.h"

#include <Eigen/SparseCholesky>
#include <Eigen/SparseLU>
#include <new>

#if defined(WINSLOW_HAS_KLU)
#include <Eigen/KLUSupport>
#endif

#if defined(WINSLOW_HAS_UMFPACK)
#include <Eigen/UmfPackSupport>
#endif

#include "core/error.h"

namespace winslow {

BlasTurn::BlasTurn(bool used) {
  static std::mutex turns;
  if (used) lock_ = std::unique_lock(turns);
}

bool EigenMatrix::assign(const SparseMatrix& source) {
  const bool fresh = pattern_ != source.pattern || block_ != at(source.block);
  if (fresh) adopt(source);
  part_ == Part::all ? values_all(source) : values_lower(source);
  return fresh;
}

void EigenMatrix::adopt(const SparseMatrix& source) {
  pattern_ = source.pattern;
  block_ = at(source.block);
  const Index n = source.rows();
  const Index entries = entries_of(part_, pattern_->columns.size(), at(pattern_->rows()), block_);
  matrix_ = Eigen::SparseMatrix<double>(n, n);
  matrix_.resizeNonZeros(entries);
  part_ == Part::all ? structure_all() : structure_lower();
}

Index EigenMatrix::entries_of(Part part, std::size_t blocks, std::size_t rows, std::size_t block) {
  // Lower triangle: half of the off-diagonal blocks, and triangles on the diagonal.
  const std::size_t entries =
      part == Part::all ? blocks * block * block
                        : (blocks - rows) / 2 * block * block + rows * block * (block + 1) / 2;
  return index_count(entries, "entries of a matrix for a direct solver");
}

void EigenMatrix::structure_all() {
  const SparsityPattern& p = *pattern_;
  const auto rows = at(p.rows());
  std::vector<std::size_t> count(rows, 0), start(rows + 1, 0);
  for (const Index column : p.columns) ++count[at(column)];
  for (std::size_t c = 0; c < rows; ++c) start[c + 1] = start[c] + count[c];
  Index* outer = matrix_.outerIndexPtr();
  for (std::size_t c = 0; c < rows; ++c) {
    for (std::size_t k = 0; k < block_; ++k) {
      outer[c * block_ + k] = static_cast<Index>((start[c] * block_ + k * count[c]) * block_);
    }
  }
  outer[rows * block_] = static_cast<Index>(start[rows] * block_ * block_);
  first_slot_.resize(p.columns.size());
  std::vector<std::size_t> next(rows, 0);
  for (std::size_t row = 0; row < rows; ++row) {
    for (auto e = at(p.offsets[row]); e < at(p.offsets[row + 1]); ++e) {
      const auto column = at(p.columns[e]);
      first_slot_[e] = (start[column] * block_ + next[column]++) * block_;
      // The scalar columns of a block column lie count * block entries apart.
      for (std::size_t c = 0; c < block_; ++c) {
        Index* inner = matrix_.innerIndexPtr() + outer[column * block_ + c] +
                       (first_slot_[e] - start[column] * block_ * block_);
        for (std::size_t r = 0; r < block_; ++r) inner[r] = static_cast<Index>(row * block_ + r);
      }
    }
  }
}

void EigenMatrix::values_all(const SparseMatrix& source) {
  const SparsityPattern& p = *pattern_;
  const Index* outer = matrix_.outerIndexPtr();
  double* out = matrix_.valuePtr();
  for (std::size_t e = 0; e < p.columns.size(); ++e) {
    const auto column = at(p.columns[e]) * block_;
    const auto stride = block_ > 1 ? at(outer[column + 1] - outer[column]) : 0;
    const double* in = &source.values[e * block_ * block_];
    for (std::size_t c = 0; c < block_; ++c) {
      for (std::size_t r = 0; r < block_; ++r) {
        out[first_slot_[e] + c * stride + r] = in[r * block_ + c];
      }
    }
  }
}

/// Column i of the lower triangle is row i of the upper one, which is how it is stored already.
void EigenMatrix::structure_lower() {
  const SparsityPattern& p = *pattern_;
  Index* outer = matrix_.outerIndexPtr();
  Index* inner = matrix_.innerIndexPtr();
  Index slot = 0;
  for (std::size_t i = 0; i < at(p.rows()); ++i) {
    for (std::size_t r = 0; r < block_; ++r) {
      *outer++ = slot;
      for (auto e = at(p.diagonal[i]); e < at(p.offsets[i + 1]); ++e) {
        for (std::size_t c = e == at(p.diagonal[i]) ? r : 0; c < block_; ++c) {
          inner[slot++] = static_cast<Index>(at(p.columns[e]) * block_ + c);
        }
      }
    }
  }
  *outer = slot;
}

void EigenMatrix::values_lower(const SparseMatrix& source) {
  const SparsityPattern& p = *pattern_;
  double* out = matrix_.valuePtr();
  for (std::size_t i = 0; i < at(p.rows()); ++i) {
    for (std::size_t r = 0; r < block_; ++r) {
      for (auto e = at(p.diagonal[i]); e < at(p.offsets[i + 1]); ++e) {
        for (std::size_t c = e == at(p.diagonal[i]) ? r : 0; c < block_; ++c) {
          *out++ = source.values[(e * block_ + r) * block_ + c];
        }
      }
    }
  }
}

namespace {

using Matrix = Eigen::SparseMatrix<double>;

#if defined(WINSLOW_HAS_KLU)
/// On square matrices the analysis can fail only for lack of memory; the factorisation then reports
/// invalid input.
bool ran_out_of_memory(Eigen::KLU<Matrix>& lu) {
  const int status = lu.kluCommon().status;
  return status == KLU_OUT_OF_MEMORY || status == KLU_TOO_LARGE || status == KLU_INVALID;
}
#endif
#if defined(WINSLOW_HAS_UMFPACK)
/// A failed analysis shows only as an invalid symbolic object; on square matrices it can fail only
/// for lack of memory.
bool ran_out_of_memory(const Eigen::UmfPackLU<Matrix>& lu) {
  return lu.umfpackFactorizeReturncode() == UMFPACK_ERROR_out_of_memory ||
         lu.umfpackFactorizeReturncode() == UMFPACK_ERROR_invalid_Symbolic_object;
}
#endif
template <typename OfEigen>
bool ran_out_of_memory(const OfEigen&) {
  return false;  // reports by an exception instead
}

/// A factorisation by a solver of Eigen, or one with the same interface.
template <typename Solver, EigenMatrix::Part part = EigenMatrix::Part::all>
class EigenFactorisation final : public Factorisation {
 public:
  explicit EigenFactorisation(const char* name) : name_(name) {
#if defined(WINSLOW_HAS_UMFPACK)
    // No iterative refinement: residuals are already at round-off.
    if constexpr (std::is_same_v<Solver, Eigen::UmfPackLU<Matrix>>) {
      solver_.umfpackControl()(UMFPACK_IRSTEP) = 0;
    }
#endif
  }

  std::string description() const override { return name_; }
  /// Eigen's interface does not say how large factors are.
  std::size_t bytes() const override { return matrix_.bytes(); }

  void factorise(const SparseMatrix& matrix) override {
    if (matrix_.assign(matrix)) solver_.analyzePattern(matrix_.matrix());
    const BlasTurn turn(uses_blas);
    solver_.factorize(matrix_.matrix());
    if (solver_.info() != Eigen::Success) {
      if (ran_out_of_memory(solver_)) throw std::bad_alloc();
      if (part == EigenMatrix::Part::lower)
        throw NotPositiveDefinite("the matrix is not positive definite (sparse Cholesky)");
      throw NumericError("the linear system is singular (sparse LU failed)");
    }
  }

  void solve(std::span<const double> rhs, int columns, std::span<double> x) override {
    using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    const Eigen::Index n = matrix_.matrix().rows();
    const Eigen::MatrixXd b = Eigen::Map<const RowMajor>(rhs.data(), n, columns);
    const BlasTurn turn(uses_blas);
    const Eigen::MatrixXd solution = solver_.solve(b);
    if (!solution.allFinite()) {
      throw NumericError("the linear system is singular to working precision");
    }
    Eigen::Map<RowMajor>(x.data(), n, columns) = solution;
  }

 private:
#if defined(WINSLOW_HAS_UMFPACK)
  static constexpr bool uses_blas = std::is_same_v<Solver, Eigen::UmfPackLU<Matrix>>;
#else
  static constexpr bool uses_blas = false;
#endif

  const char* name_;
  EigenMatrix matrix_{part};
  Solver solver_;
};

}  // namespace

#if !defined(WINSLOW_HAS_CHOLMOD)
std::unique_ptr<Factorisation> make_cholesky() {
  using Cholesky = Eigen::SimplicialLLT<Matrix>;
  return std::make_unique<EigenFactorisation<Cholesky, EigenMatrix::Part::lower>>(
      "Eigen simplicial Cholesky");
}
#endif

std::unique_ptr<Factorisation> make_lu([[maybe_unused]] Index rows) {
#if defined(WINSLOW_HAS_UMFPACK)
#if defined(WINSLOW_HAS_KLU)
  // For smaller matrices dense kernels are not faster.
  constexpr Index umfpack_limit = 8'000;
  if (rows < umfpack_limit || !blas_has_memory())
    return std::make_unique<EigenFactorisation<Eigen::KLU<Matrix>>>("KLU sparse LU");
#endif
  return std::make_unique<EigenFactorisation<Eigen::UmfPackLU<Matrix>>>("UMFPACK sparse LU");
#elif defined(WINSLOW_HAS_KLU)
  return std::make_unique<EigenFactorisation<Eigen::KLU<Matrix>>>("KLU sparse LU");
#else
  return std::make_unique<EigenFactorisation<Eigen::SparseLU<Matrix>>>("Eigen sparse LU");
#endif
}

}  // namespace winslow
