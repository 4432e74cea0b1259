#pragma once

#include "core/linear/blocks.h"
#include "core/linear/preconditioner.h"
#include "core/linear/sparse_system.h"

namespace winslow {

/// Threaded block Gauss-Seidel sweeps over a symmetric positive definite matrix: Gauss-Seidel
/// within each run of parallel_block rows, Jacobi between runs. With A = L + D + L^T + O, where L
/// is the strictly lower part within runs and O the coupling of different runs,
///
///   M = L + D C,
///
/// where the diagonal C is 1 except where O outweighs D, such that M + M^T - A is positive
/// definite. Then the sweep never diverges (A. Baker, R. Falgout, T. Kolev and U. Yang, SIAM J.
/// Sci. Comput. 33, 2011).
class GaussSeidel {
 public:
  /// Copies the matrix. Throws NotPositiveDefinite if a block on the diagonal is not. width:
  /// right-hand sides at once, 1, or 4 for a scalar matrix. Vectors have row_stride(block, width)
  /// numbers a row.
  void build(const SparseMatrix& matrix, int threads, int width = 1);

  /// x = M^-1 b, the forward sweep from x = 0, and r = b - A x.
  void forward(std::span<const Real> b, std::span<Real> x, std::span<Real> r, int threads) const;
  /// x += M^-T (b - A x), the backward sweep. before: a copy of x on entry.
  void backward(std::span<const Real> b, std::span<const Real> before, std::span<Real> x,
                int threads) const;

  /// Without the pattern, which is that of the matrix.
  std::size_t bytes() const { return bytes_of(values_, inverse_, excess_, inside_); }

  /// r = b - A x; b and r may be the same.
  void defect(std::span<const Real> b, std::span<const Real> x, std::span<Real> r,
              int threads) const;

 private:
  template <typename Visit>
  void each_run(int threads, Visit&& visit) const;
  template <typename Visit>
  void each_run_of_vectors(int threads, Visit&& visit) const;
  // In the following, N is the stride of the vectors.
  /// Adds the products with the entries [first, last) of the matrix.
  template <int B, int N>
  void add(Index first, Index last, std::span<const Real> x, BlockSum<B, N>& sum) const {
    sum.add(values_.data(), pattern_->columns.data(), first, last, x.data());
  }
  template <int B>
  void factor_rows(const SparseMatrix& matrix, Index begin, Index end,
                   std::span<double> inverse_factors);
  template <int B>
  void build_rows(const SparseMatrix& matrix, std::span<const double> inverse_factors, Index begin,
                  Index end);
  template <int B, int N>
  void forward_rows(std::span<const Real> b, std::span<Real> x, Index begin, Index end) const;
  template <int B, int N>
  void defect_after_forward(std::span<const Real> x, std::span<Real> r, Index begin,
                            Index end) const;
  template <int B, int N>
  void backward_rows(std::span<const Real> b, std::span<const Real> before, std::span<Real> x,
                     Index begin, Index end) const;

  std::shared_ptr<const SparsityPattern> pattern_;
  int block_ = 1, width_ = 1;
  std::vector<Real> values_;   // blocks, column-major, and a tail
  std::vector<Real> inverse_;  // (D C)^-1, row by row, likewise
  std::vector<Real> excess_;   // C - 1, row by row
  std::vector<Index> inside_;  // #rows by 2: first and end entry of a row within its run
};

/// One W-cycle of algebraic multigrid by smoothed aggregation (P. Vanek, J. Mandel and M. Brezina,
/// Computing 56, 1996) with block Gauss-Seidel smoothing, forward on the way down and backward on
/// the way up, so that it is symmetric. The coarse levels represent the constant vector of each
/// component exactly: the rigid translations of a mesh.
///
/// For symmetric positive definite matrices. The hierarchy of aggregates is kept while the pattern
/// object stays the same; its values are rebuilt. In single precision. threads: 0 for all cores; no
/// result depends on it.
std::unique_ptr<Preconditioner> make_multigrid(int threads);

/// The same cycle for scalar matrices and three right-hand sides at once, in one pass over the
/// matrix: vectors hold #rows by 3 numbers, as those of a mesh in space.
std::unique_ptr<Preconditioner> make_multigrid_of_components(int threads);

}  // namespace winslow
