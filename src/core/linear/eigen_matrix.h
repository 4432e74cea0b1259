#pragma once

#include <Eigen/SparseCore>
#include <memory>
#include <vector>

#include "core/linear/sparse_system.h"

namespace winslow {

/// Copies systems into Eigen's column-major matrices, the form its solvers take. Where each value
/// goes is worked out once per pattern.
class EigenMatrix {
 public:
  /// Returns true if the pattern is a new one.
  bool assign(const SparseSystem& system) {
    const bool fresh = pattern_ != system.pattern;
    if (fresh) adopt(system.pattern);
    double* values = matrix_.valuePtr();
    for (std::size_t e = 0; e < target_.size(); ++e) values[target_[e]] = system.values[e];
    return fresh;
  }
  const Eigen::SparseMatrix<double>& matrix() const { return matrix_; }

 private:
  void adopt(std::shared_ptr<const SparsityPattern> pattern) {
    pattern_ = std::move(pattern);
    const Index n = pattern_->rows();
    matrix_ = Eigen::SparseMatrix<double>(n, n);
    matrix_.resizeNonZeros(static_cast<Index>(pattern_->columns.size()));
    Index* starts = matrix_.outerIndexPtr();
    std::fill(starts, starts + n + 1, 0);
    for (const Index column : pattern_->columns) ++starts[column + 1];
    for (Index c = 0; c < n; ++c) starts[c + 1] += starts[c];
    std::vector<Index> next(starts, starts + n);
    target_.resize(pattern_->columns.size());
    for (Index row = 0; row < n; ++row) {
      const auto begin = static_cast<std::size_t>(pattern_->offsets[static_cast<std::size_t>(row)]);
      const auto end =
          static_cast<std::size_t>(pattern_->offsets[static_cast<std::size_t>(row) + 1]);
      for (std::size_t e = begin; e < end; ++e) {
        const Index slot = next[static_cast<std::size_t>(pattern_->columns[e])]++;
        matrix_.innerIndexPtr()[slot] = row;
        target_[e] = slot;
      }
    }
  }

  std::shared_ptr<const SparsityPattern> pattern_;
  Eigen::SparseMatrix<double> matrix_;
  std::vector<Index> target_;  // slot of each entry in the column-major matrix
};

}  // namespace winslow
