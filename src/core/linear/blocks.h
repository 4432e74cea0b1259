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

/// Vectors of multigrid have `stride` numbers for each row: as many as a block, but four for blocks
/// of three and for several right-hand sides of a scalar matrix. So a row is loaded and stored at
/// once: a load that spans two recent stores waits for both.
constexpr int row_stride(int block, int width) { return block == 3 || width == 4 ? 4 : block; }

/// with_block() with the stride as a second constant. width: of scalar matrices, right-hand sides
/// at once: 1 or 4.
template <typename Body>
decltype(auto) with_shape(int block, int width, Body&& body) {
  using One = std::integral_constant<int, 1>;
  if (block == 1 && width == 4) return body(One{}, std::integral_constant<int, 4>{});
  if (width != 1) throw UsageError("only scalar matrices take several right-hand sides at once");
  return with_block(block, [&](auto size) {
    return body(size, std::integral_constant<int, row_stride(size(), 1)>{});
  });
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

/// Smallest eigenvalue of a symmetric block; only its lower triangle is read. NaN if the block is
/// not finite.
template <int B>
double smallest_eigenvalue(const Block<double, B>& a) {
  if constexpr (B == 1) return a(0, 0);
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, B, B>> eigen;
  return eigen.computeDirect(a, Eigen::EigenvaluesOnly).eigenvalues()[0];
}

/// out = sum of A_e x_column(e) over the entries [first, last), the innermost loop of Krylov
/// methods. values: blocks, B by B and row-major; x: B numbers for each column.
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

/// One row of a vector of multigrid, N numbers.
template <int N>
struct RowOf {
  typedef Real Numbers __attribute__((vector_size(sizeof(Real) * N)));
};
template <int N>
using Row = typename RowOf<N>::Numbers;

template <int N>
inline Row<N> load_row(const Real* from) {
  Row<N> row;
  std::memcpy(&row, from, sizeof row);
  return row;
}
template <int N>
inline void store_row(const Row<N>& row, Real* to) {
  std::memcpy(to, &row, sizeof row);
}

/// What arrays of 3 by 3 blocks have beyond their end, because rows of four numbers are loaded of
/// them: the fourth one belongs to the next block, and is not used.
constexpr std::size_t block_tail = 3;

/// A sum of products A x of blocks and rows of N numbers, N the stride of B: the innermost loop of
/// multigrid. Blocks are column-major, so that no numbers of a row are added up. Several sums, so
/// that an addition need not wait for the one before.
template <int B, int N>
class BlockSum {
 public:
  void add(const Real* a, const Real* x) {
    if constexpr (B == 1) {
      sums_[0] += a[0] * load_row<N>(x);
    } else {
      const Row<N> from = load_row<N>(x);
      for (int c = 0; c < B; ++c) sums_[c] += load_row<N>(a + std::ptrdiff_t{B} * c) * from[c];
    }
  }
  /// Adds the products with the entries [first, last) of a matrix, the last one at the end, so that
  /// its row of x may be the latest to be known.
  void add(const Real* values, const Index* columns, Index first, Index last, const Real* x) {
    Index e = first;
    if constexpr (B == 1) {
      for (; e + 1 < last; e += 2) {
        sums_[1] += values[e] * load_row<N>(x + std::ptrdiff_t{N} * columns[e]);
        sums_[0] += values[e + 1] * load_row<N>(x + std::ptrdiff_t{N} * columns[e + 1]);
      }
    }
    for (; e < last; ++e)
      add(values + std::ptrdiff_t{B} * B * e, x + std::ptrdiff_t{N} * columns[e]);
  }
  Row<N> total() const {
    if constexpr (B == 3) return sums_[0] + (sums_[1] + sums_[2]);
    return sums_[0] + sums_[1];
  }

 private:
  Row<N> sums_[B == 3 ? 3 : 2]{};
};

/// A x for a column-major block.
template <int B, int N>
inline Row<N> block_times(const Real* a, const Row<N>& x) {
  if constexpr (B == 1) return a[0] * x;
  Row<N> sum = load_row<N>(a) * x[0];
  for (int c = 1; c < B; ++c) sum += load_row<N>(a + std::ptrdiff_t{B} * c) * x[c];
  return sum;
}

}  // namespace winslow
