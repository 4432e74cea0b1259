#pragma once

#include <memory>
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

}  // namespace winslow
