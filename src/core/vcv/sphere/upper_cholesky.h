#pragma once

#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace winslow {

/// Solves A x = b for one small symmetric positive definite matrix after another. Rows lie one
/// after the other, so that each update of the factorisation runs along two of them, and rows that
/// meet a zero are passed over: with unknowns of few neighbours first, most of them do.
class UpperCholesky {
 public:
  /// A matrix of n by n zeros.
  void reset(std::size_t n) {
    size_ = n;
    values_.assign(n * n, 0.0);
  }
  std::size_t size() const { return size_; }

  /// Entry of the upper triangle, row <= column.
  double& operator()(std::size_t row, std::size_t column) { return values_[row * size_ + column]; }
  double operator()(std::size_t row, std::size_t column) const {
    return values_[row * size_ + column];
  }

  /// A = U^T U, U in the place of A. False, with what was done so far, where a pivot is not
  /// positive.
  bool factorise() {
    for (std::size_t j = 0; j < size_; ++j) {
      double* const row = values_.data() + j * size_;
      if (!(row[j] > 0)) return false;
      const double inverse = 1 / std::sqrt(row[j]);
      for (std::size_t k = j; k < size_; ++k) row[k] *= inverse;
      for (std::size_t i = j + 1; i < size_; ++i) {
        const double factor = row[i];
        if (factor == 0) continue;
        double* const other = values_.data() + i * size_;
        for (std::size_t k = i; k < size_; ++k) other[k] -= factor * row[k];
      }
    }
    return true;
  }

  /// x = A^-1 x with the factor.
  void solve(std::span<double> x) const {
    for (std::size_t j = 0; j < size_; ++j) {
      const double* const row = values_.data() + j * size_;
      x[j] /= row[j];
      for (std::size_t k = j + 1; k < size_; ++k) x[k] -= row[k] * x[j];
    }
    for (std::size_t j = size_; j-- > 0;) {
      const double* const row = values_.data() + j * size_;
      double sum = x[j];
      for (std::size_t k = j + 1; k < size_; ++k) sum -= row[k] * x[k];
      x[j] = sum / row[j];
    }
  }

 private:
  std::size_t size_ = 0;
  std::vector<double> values_;
};

}  // namespace winslow
