#pragma once

#include <span>
#include <string>

#include "core/linear/sparse_system.h"

namespace winslow {

/// What a computation moves and calculates, counted from its data structures: each array once for
/// each sweep over it, as if no cache held it from one sweep to the next.
struct Work {
  double bytes = 0, flops = 0;
};

/// A cheap linear approximation M of a matrix, for Krylov methods.
class Preconditioner {
 public:
  virtual ~Preconditioner() = default;
  /// E.g. "incomplete LU with threshold".
  virtual std::string description() const = 0;
  /// Keeps data that depend only on the pattern object and the block size from call to call. Throws
  /// NumericError or NotPositiveDefinite; then call build() again before apply().
  virtual void build(const SparseMatrix& matrix) = 0;
  /// z = M^-1 r. r and z: #scalar rows, different arrays.
  virtual void apply(std::span<const double> r, std::span<double> z) = 0;
  /// Of one apply(); zeros where nobody counts it.
  virtual Work work() const { return {}; }
  /// Memory that it keeps from call to call.
  virtual std::size_t bytes() const = 0;
};

/// Incomplete block Cholesky factorisation without fill, within runs of parallel_block rows.
/// Entries that couple different runs are dropped, so that runs are factorised and solved in
/// parallel. A pivot that is not safely positive is replaced by the block of the matrix itself. For
/// symmetric positive definite matrices. threads: 0 for all cores.
std::unique_ptr<Preconditioner> make_incomplete_cholesky(int threads);

/// Incomplete LU factorisation with threshold (ILUT), scalar, for matrices of any kind.
std::unique_ptr<Preconditioner> make_incomplete_lu();

/// A copy of a matrix with rows and columns in a cache-friendly order (see locality_ordering): mesh
/// generators number nodes almost at random. The order is computed once per pattern object.
class ReorderedMatrix {
 public:
  void assign(const SparseMatrix& source, int threads);
  /// Its pattern object changes when, and only when, that of the source does.
  const SparseMatrix& matrix() const { return matrix_; }
  std::size_t bytes() const {
    return bytes_of(matrix_.values, order_, source_entry_) + bytes_of(matrix_.pattern);
  }

  /// Copies one column of an array, stored by rows in the order of the source, to the new order.
  void gather(std::span<const double> source, int columns, int column,
              std::span<double> vector) const;
  void scatter(std::span<const double> vector, int columns, int column,
               std::span<double> target) const;

 private:
  void adopt(std::shared_ptr<const SparsityPattern> pattern);

  std::shared_ptr<const SparsityPattern> source_pattern_;
  SparseMatrix matrix_;
  std::vector<Index> order_;         // source row of each new row
  std::vector<Index> source_entry_;  // source entry of each new entry
};

}  // namespace winslow
