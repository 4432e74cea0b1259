#pragma once

#include <memory>
#include <span>
#include <string>

#include "core/linear/sparse_system.h"

namespace winslow {

/// A cheap linear approximation M of a matrix, for Krylov methods.
class Preconditioner {
 public:
  virtual ~Preconditioner() = default;
  /// "incomplete LU with threshold", say.
  virtual std::string description() const = 0;
  /// What depends on the pattern object and the block size alone is kept from call to call.
  /// Throws NumericError or NotPositiveDefinite; then another matrix is wanted.
  virtual void build(const SparseMatrix& matrix) = 0;
  /// z = M^-1 r. r and z: #scalar rows, different arrays.
  virtual void apply(std::span<const double> r, std::span<double> z) = 0;
};

}  // namespace winslow
