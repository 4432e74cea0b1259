#pragma once

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <string>
#include <type_traits>
#include <utility>

#include "core/error.h"

/// Dense blocks of sparse matrices, their size known to the compiler.
namespace winslow {

/// Calls body with std::integral_constant<int, block>, for loops that the compiler unrolls. Throws
/// UsageError for blocks larger than 3 by 3: there are no more unknowns to a node of a mesh.
template <typename Body>
decltype(auto) with_block(int block, Body&& body) {
  switch (block) {
    case 1:
      return body(std::integral_constant<int, 1>{});
    case 2:
      return body(std::integral_constant<int, 2>{});
    case 3:
      return body(std::integral_constant<int, 3>{});
    default:
      throw UsageError("the matrix has " + std::to_string(block) +
                       " unknowns a row, expected 1, 2 or 3");
  }
}

/// B by B, row-major, as in SparseMatrix::values.
template <typename Scalar, int B>
using Block = Eigen::Matrix<Scalar, B, B, B == 1 ? Eigen::ColMajor : Eigen::RowMajor>;

/// y += A x.
template <int B, typename A, typename X, typename Y>
inline void multiply_add(const A* a, const X* x, Y* y) {
  for (int r = 0; r < B; ++r) {
    for (int c = 0; c < B; ++c) y[r] += a[r * B + c] * x[c];
  }
}

/// y -= A x.
template <int B, typename A, typename X, typename Y>
inline void multiply_subtract(const A* a, const X* x, Y* y) {
  for (int r = 0; r < B; ++r) {
    for (int c = 0; c < B; ++c) y[r] -= a[r * B + c] * x[c];
  }
}

/// y -= A^T x.
template <int B, typename A, typename X, typename Y>
inline void subtract_transposed(const A* a, const X* x, Y* y) {
  for (int r = 0; r < B; ++r) {
    for (int c = 0; c < B; ++c) y[c] -= a[r * B + c] * x[r];
  }
}

/// y = A x.
template <int B, typename A, typename X, typename Y>
inline void multiply(const A* a, const X* x, Y* y) {
  for (int r = 0; r < B; ++r) {
    y[r] = 0;
    for (int c = 0; c < B; ++c) y[r] += a[r * B + c] * x[c];
  }
}

/// Of a symmetric block; its lower triangle is read. NaN if the block is not finite.
template <int B>
double smallest_eigenvalue(const Block<double, B>& a) {
  if constexpr (B == 1) return a(0, 0);
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, B, B>> eigen;
  return eigen.computeDirect(a, Eigen::EigenvaluesOnly).eigenvalues()[0];
}

}  // namespace winslow
