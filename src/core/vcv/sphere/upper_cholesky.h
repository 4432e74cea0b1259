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

  /// A = U^T U, U in the place of A, with the inverse of its diagonal. False, with what was done so
  /// far, where a pivot is not positive.
  bool factorise() {
    std::size_t j = 0;
    for (; j + 1 < size_; j += 2) {  // two rows at once: half the traffic
      const double* const first = row(j);
      const double* const second = row(j + 1);
      if (!scale(j)) return false;
      subtract(j + 1, first, first[j + 1]);
      if (!scale(j + 1)) return false;
      for (std::size_t i = j + 2; i < size_; ++i) {
        const double a = first[i], b = second[i];
        if (a == 0 && b == 0) continue;
        double* __restrict other = row(i);
        for (std::size_t k = i; k < size_; ++k) other[k] -= a * first[k] + b * second[k];
      }
    }
    return j == size_ || scale(j);
  }

  /// x = A^-1 x with the factor.
  void solve(std::span<double> x) const {
    for (std::size_t j = 0; j < size_; ++j) {
      const double* const own = row(j);
      const double value = x[j] * own[j];
      for (std::size_t k = j + 1; k < size_; ++k) x[k] -= own[k] * value;
      x[j] = value;
    }
    for (std::size_t j = size_; j-- > 0;) {
      const double* const own = row(j);
      double even = x[j], odd = 0;  // two sums: neither waits for the other
      std::size_t k = j + 1;
      for (; k + 1 < size_; k += 2) {
        even -= own[k] * x[k];
        odd -= own[k + 1] * x[k + 1];
      }
      if (k < size_) even -= own[k] * x[k];
      x[j] = (even + odd) * own[j];
    }
  }

 private:
  double* row(std::size_t j) { return values_.data() + j * size_; }
  const double* row(std::size_t j) const { return values_.data() + j * size_; }

  bool scale(std::size_t j) {
    double* const own = row(j);
    if (!(own[j] > 0)) return false;
    const double inverse = 1 / std::sqrt(own[j]);
    own[j] = inverse;
    for (std::size_t k = j + 1; k < size_; ++k) own[k] *= inverse;
    return true;
  }
  /// Row i minus the factor times another, from column i on.
  void subtract(std::size_t i, const double* other, double factor) {
    double* __restrict own = row(i);
    for (std::size_t k = i; k < size_; ++k) own[k] -= factor * other[k];
  }

  std::size_t size_ = 0;
  std::vector<double> values_;
};

}  // namespace winslow
