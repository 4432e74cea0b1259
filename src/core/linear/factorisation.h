#pragma once

#include <Eigen/SparseCore>
#include <atomic>
#include <cstdlib>
#include <mutex>

#include "core/counts.h"
#include "core/linear/sparse_system.h"

namespace winslow {

/// A sparse factorisation. Keeps the ordering and the symbolic factorisation while pattern and
/// block size stay the same.
class Factorisation {
 public:
  virtual ~Factorisation() = default;
  /// E.g. "CHOLMOD supernodal Cholesky".
  virtual std::string description() const = 0;
  /// Throws NumericError (singular) or NotPositiveDefinite; then factorise() another matrix before
  /// solve().
  virtual void factorise(const SparseMatrix& matrix) = 0;
  /// Solves with the last matrix. rhs, x: #scalar rows by columns, row after row.
  /// Throws NumericError if the solution is not finite.
  virtual void solve(std::span<const double> rhs, int columns, std::span<double> x) = 0;
  /// Memory that it keeps from call to call, as far as the library behind it tells.
  virtual std::size_t bytes() const = 0;
};

/// Sparse Cholesky, L L^T, of symmetric positive definite matrices.
std::unique_ptr<Factorisation> make_cholesky();

/// Sparse LU for matrices of about `rows` scalar rows: KLU for small ones, UMFPACK for large ones,
/// if the build has them; otherwise Eigen's.
std::unique_ptr<Factorisation> make_lu(Index rows);

/// Whether BLAS can allocate its work memory. OpenBLAS allocates a buffer of 128 MB at its first
/// call and keeps it. If the allocation fails (a limit of the address space), OpenBLAS retries
/// forever. So test the allocation before the first call.
inline bool blas_has_memory() {
  static std::atomic<bool> had = false;
  constexpr std::size_t buffer = std::size_t{160} << 20;
  if (had) return true;
  void* volatile const probe = std::malloc(buffer);  // volatile: prevents its elimination
  had = probe != nullptr;
  std::free(probe);
  return had;
}

/// A lock for calls of BLAS by SuiteSparse. Debian's serial OpenBLAS hands out its buffers without
/// a lock: two threads with separate factorisations could get the same buffer and wrong numbers. So
/// concurrent runs take turns here.
class BlasTurn {
 public:
  /// used: false if no dense kernels are called: then no lock is taken.
  explicit BlasTurn(bool used = true);

 private:
  std::unique_lock<std::mutex> lock_;
};

/// Expands block matrices into the compressed scalar columns of Eigen and SuiteSparse. The
/// structure is computed once per pattern and block size.
class EigenMatrix {
 public:
  enum class Part {
    all,
    lower  ///< lower triangle of a symmetric matrix
  };
  explicit EigenMatrix(Part part) : part_(part) {}

  /// Returns true if the structure has changed.
  bool assign(const SparseMatrix& source);
  const Eigen::SparseMatrix<double>& matrix() const { return matrix_; }
  std::size_t bytes() const {
    return static_cast<std::size_t>(matrix_.nonZeros()) * (sizeof(double) + sizeof(Index)) +
           static_cast<std::size_t>(matrix_.outerSize() + 1) * sizeof(Index) +
           bytes_of(first_slot_);
  }
  /// Scalar entries of a part of a matrix of so many blocks, `rows` of them on the diagonal. Throws
  /// UsageError if there are more than the factorisations number.
  static Index entries_of(Part part, std::size_t blocks, std::size_t rows, std::size_t block);

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
  std::vector<std::size_t> first_slot_;  // Part::all: position of each block's upper left scalar
};

}  // namespace winslow
