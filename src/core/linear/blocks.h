#pragma once

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <cstring>
#include <type_traits>
#include <utility>

#include "core/error.h"
#include "core/types.h"

namespace winslow {

/// Multigrid is only a preconditioner, so halving the memory traffic matters more than precision.
using Real = float;

/// Dense blocks of sparse matrices, with a size known at compile time.

/// Calls body with std::integral_constant<int, block>, for loops that the compiler unrolls. Throws
/// UsageError for blocks larger than 3 by 3: a node has at most three unknowns.
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

/// The same with how many numbers a vector has for each row as a second constant. width: of scalar
/// matrices, right-hand sides at once: 1 or 4.
template <typename Body>
decltype(auto) with_shape(int block, int width, Body&& body) {
  using One = std::integral_constant<int, 1>;
  if (block == 1 && width == 4) return body(One{}, std::integral_constant<int, 4>{});
  if (width != 1) throw UsageError("only scalar matrices take several right-hand sides at once");
  return with_block(block, [&](auto size) { return body(size, size); });
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

/// y = A x for a row of N = B numbers, or for N right-hand sides of a scalar.
template <int B, int N, typename A, typename X, typename Y>
inline void multiply_row(const A* a, const X* x, Y* y) {
  if constexpr (N == B)
    multiply<B>(a, x, y);
  else
    for (int k = 0; k < N; ++k) y[k] = a[0] * x[k];
}

/// The same, y += A x.
template <int B, int N, typename A, typename X, typename Y>
inline void multiply_add_row(const A* a, const X* x, Y* y) {
  if constexpr (N == B)
    multiply_add<B>(a, x, y);
  else
    for (int k = 0; k < N; ++k) y[k] += a[0] * x[k];
}

/// Smallest eigenvalue of a symmetric block; only its lower triangle is read. NaN if the block is
/// not finite.
template <int B>
double smallest_eigenvalue(const Block<double, B>& a) {
  if constexpr (B == 1) return a(0, 0);
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, B, B>> eigen;
  return eigen.computeDirect(a, Eigen::EigenvaluesOnly).eigenvalues()[0];
}

/// Products of rows of blocks with a vector, the innermost loops of all iterative solvers.

/// out = sum of A_e x_column(e) over the entries [first, last). values: blocks, B by B and
/// row-major; x: B numbers for each column.
template <int B, typename T>
inline void row_product(const T* values, const Index* columns, Index first, Index last, const T* x,
                        T* out) {
  for (int r = 0; r < B; ++r) out[r] = 0;
  const T* a = values + static_cast<std::ptrdiff_t>(B) * B * first;
  for (Index e = first; e < last; ++e, a += B * B) {
    const T* from = x + static_cast<std::ptrdiff_t>(B) * columns[e];
    for (int r = 0; r < B; ++r) {
      for (int c = 0; c < B; ++c) out[r] += a[r * B + c] * from[c];
    }
  }
}

/// The same for 3 by 3 blocks in single precision, one row of a block at a time: four numbers, of
/// which three are used. Nothing is read beyond the last block: its last row is loaded from one
/// number earlier, with x shifted by one lane. (Double precision has no gain: it is limited by
/// memory bandwidth.)
template <>
inline void row_product<3, float>(const float* values, const Index* columns, Index first,
                                  Index last, const float* x, float* out) {
  typedef float Pack __attribute__((vector_size(16)));
  Pack r0{}, r1{}, r2{};
  const float* a = values + std::ptrdiff_t{9} * first;
  for (Index e = first; e < last; ++e, a += 9) {
    const float* from = x + std::ptrdiff_t{3} * columns[e];
    const Pack v = {from[0], from[1], from[2], 0};
    Pack a0, a1, a2;
    std::memcpy(&a0, a, sizeof a0);
    std::memcpy(&a1, a + 3, sizeof a1);
    std::memcpy(&a2, a + 5, sizeof a2);
    r0 += a0 * v;
    r1 += a1 * v;
    r2 += a2 * __builtin_shufflevector(v, v, 3, 0, 1, 2);
  }
  out[0] = r0[0] + r0[1] + r0[2];
  out[1] = r1[0] + r1[1] + r1[2];
  out[2] = r2[1] + r2[2] + r2[3];
}

/// The same for a scalar matrix and four right-hand sides at once, the numbers of a row side by
/// side.
inline void wide_row_product(const float* values, const Index* columns, Index first, Index last,
                             const float* x, float* out) {
  typedef float Pack __attribute__((vector_size(16)));
  const auto term = [&](Index e) {
    Pack from;
    std::memcpy(&from, x + std::ptrdiff_t{4} * columns[e], sizeof from);
    return values[e] * from;
  };
  Pack even{}, odd{};  // two sums, so that an addition need not wait for the one before
  Index e = first;
  for (; e + 1 < last; e += 2) {
    even += term(e);
    odd += term(e + 1);
  }
  if (e < last) even += term(e);
  even += odd;
  std::memcpy(out, &even, sizeof even);
}

}  // namespace winslow
