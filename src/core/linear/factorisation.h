#pragma once

#include <Eigen/SparseCore>
#include <atomic>
#include <cstdlib>
#include <mutex>
#include <span>
#include <string>

#include "core/linear/sparse_system.h"

namespace winslow {

/// A sparse factorisation. Ordering and symbolic work are kept while pattern and block size stay.
class Factorisation {
 public:
  virtual ~Factorisation() = default;
  /// "CHOLMOD supernodal Cholesky", say.
  virtual std::string description() const = 0;
  /// Throws NumericError (singular) or NotPositiveDefinite; then another matrix is wanted.
  virtual void factorise(const SparseMatrix& matrix) = 0;
  /// Solves with the last matrix. rhs, x: #scalar rows by columns, row after row.
  /// Throws NumericError if the solution is not finite.
  virtual void solve(std::span<const double> rhs, int columns, std::span<double> x) = 0;
};

/// Sparse Cholesky, L L^T, of symmetric positive definite matrices.
std::unique_ptr<Factorisation> make_cholesky();

/// Sparse LU for matrices of about so many scalar rows: KLU for small ones, UMFPACK for large ones,
/// as far as the build has them; else Eigen's.
std::unique_ptr<Factorisation> make_lu(Index rows);

/// Whether a call of BLAS will find memory to work in. OpenBLAS takes a buffer of 128 MB at its
/// first call and keeps it; where there is none to be had (a limit of the address space) it asks
/// again and again, for ever. So ask before it does.
inline bool blas_has_memory() {
  static std::atomic<bool> had = false;
  constexpr std::size_t buffer = std::size_t{160} << 20;
  if (had) return true;
  void* volatile const probe = std::malloc(buffer);  // volatile: the compiler may not leave it out
  had = probe != nullptr;
  std::free(probe);
  return had;
}

/// Held while SuiteSparse calls BLAS. Debian's serial OpenBLAS hands its buffers out without a
/// lock, so that two threads at once, each with a factorisation of its own, would get the same one
/// and wrong numbers. Runs that go on at the same time take turns here.
class BlasTurn {
 public:
  /// used: false where no dense kernels are called: nothing is held then.
  explicit BlasTurn(bool used = true);

 private:
  std::unique_lock<std::mutex> lock_;
};

/// Expands block matrices into the compressed scalar columns that Eigen and SuiteSparse take. The
/// structure is worked out once per pattern and block size.
class EigenMatrix {
 public:
  enum class Part {
    all,
    lower  ///< lower triangle of a symmetric matrix
  };
  explicit EigenMatrix(Part part) : part_(part) {}

  /// Returns true if the structure is a new one.
  bool assign(const SparseMatrix& source);
  const Eigen::SparseMatrix<double>& matrix() const { return matrix_; }

 private:
  void adopt(const SparseMatrix& source);
  void structure_all();
  void structure_lower();
  void values_all(const SparseMatrix& source);
  void values_lower(const SparseMatrix& source);

  Part part_;
  std::shared_ptr<const SparsityPattern> pattern_;
  std::size_t block_ = 0;
  Eigen::SparseMatrix<double> matrix_;
  std::vector<std::size_t> first_slot_;  // all: where the upper left scalar of each block goes
};

}  // namespace winslow
