#pragma once

#include <Eigen/SparseCore>
#include <memory>
#include <vector>

#include "core/linear/sparse_system.h"

namespace winslow {

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
