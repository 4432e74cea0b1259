#pragma once

#include <memory>
#include <span>
#include <vector>

#include "core/linear/sparse_system.h"

namespace winslow {

/// A copy of a matrix with rows and columns in an order that is good to caches (see
/// locality_ordering): mesh generators number nodes almost at random. The order is worked out once
/// per pattern object.
class ReorderedMatrix {
 public:
  void assign(const SparseMatrix& source, int threads);
  /// Its pattern object changes when, and only when, that of the source does.
  const SparseMatrix& matrix() const { return matrix_; }

  /// One column of an array that is row after row in the order of the source.
  void gather(std::span<const double> source, int columns, int column,
              std::span<double> vector) const;
  void scatter(std::span<const double> vector, int columns, int column,
               std::span<double> target) const;

 private:
  void adopt(std::shared_ptr<const SparsityPattern> pattern);

  std::shared_ptr<const SparsityPattern> source_pattern_;
  SparseMatrix matrix_;
  std::vector<Index> order_;         // source row of each row
  std::vector<Index> source_entry_;  // of each entry
};

}  // namespace winslow
