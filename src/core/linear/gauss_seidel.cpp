#include "core/linear/gauss_seidel.h"

#include <Eigen/Cholesky>
#include <algorithm>

#include "core/error.h"
#include "core/linear/blocks.h"
#include "core/linear/worthwhile.h"
#include "core/parallel/parallel_for.h"

namespace winslow {

namespace {

template <int B>
Eigen::Map<const Block<double, B>> block_at(const SparseMatrix& matrix, std::size_t entry) {
  return Eigen::Map<const Block<double, B>>(&matrix.values[entry * B * B]);
}

/// Cholesky factor of a block on the diagonal.
template <int B>
Eigen::LLT<Eigen::Matrix<double, B, B>> factor_diagonal(const SparseMatrix& matrix, Index row) {
  const auto d = block_at<B>(matrix, at(matrix.pattern->diagonal[at(row)]));
  Eigen::LLT<Eigen::Matrix<double, B, B>> llt(d);
  if (llt.info() != Eigen::Success || !(d.diagonal().minCoeff() > 0)) {
    throw NotPositiveDefinite("the matrix is not positive definite (a block on its diagonal)");
  }
  return llt;
}

/// How much the connections of a row to other runs weigh in units of the diagonal: the sum of the
/// Frobenius norms of D_i^-1/2 A_ij D_j^-1/2 over the columns outside [begin, end).
template <int B>
double outside_weight(const SparseMatrix& matrix, Index row, Index begin, Index end) {
  const SparsityPattern& p = *matrix.pattern;
  double sum = 0;
  for (auto e = at(p.offsets[at(row)]); e < at(p.offsets[at(row) + 1]); ++e) {
    const Index j = p.columns[e];
    if (j >= begin && j < end) continue;
    Eigen::Matrix<double, B, B> scaled = block_at<B>(matrix, e);
    factor_diagonal<B>(matrix, row).matrixL().solveInPlace(scaled);
    scaled.transposeInPlace();
    factor_diagonal<B>(matrix, j).matrixL().solveInPlace(scaled);
    sum += scaled.norm();
  }
  return sum;
}

}  // namespace

void GaussSeidel::build(const SparseMatrix& matrix, int threads) {
  pattern_ = matrix.pattern;
  block_ = matrix.block;
  const auto rows = at(pattern_->rows());
  values_.resize(matrix.values.size());
  inverse_.resize(rows * at(block_) * at(block_));
  excess_.resize(rows);
  with_block(block_, [&](auto size) {
    parallel_for(worthwhile(threads, values_.size()), pattern_->rows(),
                 [&](Index begin, Index end) { build_rows<size()>(matrix, begin, end); });
  });
}

template <int B>
void GaussSeidel::build_rows(const SparseMatrix& matrix, Index begin, Index end) {
  const auto first = at(pattern_->offsets[at(begin)]) * B * B;
  const auto last = at(pattern_->offsets[at(end)]) * B * B;
  std::transform(&matrix.values[first], matrix.values.data() + last, &values_[first],
                 [](double v) { return static_cast<Real>(v); });
  for (Index i = begin; i < end; ++i) {
    // M + M^T - A = D (2 C - 1) - O is positive definite if 2 C - 1 exceeds the weight of O.
    constexpr double margin = 0.9;
    const double outside = outside_weight<B>(matrix, i, begin, end);
    const double excess = std::max(0.0, (outside - margin) / 2);
    excess_[at(i)] = static_cast<Real>(excess);
    const Eigen::Matrix<double, B, B> inverse =
        factor_diagonal<B>(matrix, i).solve(Eigen::Matrix<double, B, B>::Identity()) / (1 + excess);
    Eigen::Map<Block<Real, B>> target(&inverse_[at(i) * B * B]);
    target = inverse.template cast<Real>();
  }
}

template <int B>
void GaussSeidel::forward_rows(std::span<const Real> b, std::span<Real> x, Index begin,
                               Index end) const {
  const SparsityPattern& p = *pattern_;
  for (auto i = at(begin); i < at(end); ++i) {
    Real sum[B];
    std::copy_n(&b[i * B], B, sum);
    for (auto e = at(p.offsets[i]); e < at(p.diagonal[i]); ++e) {
      if (p.columns[e] < begin) continue;
      multiply_subtract<B>(&values_[e * B * B], &x[at(p.columns[e]) * B], sum);
    }
    multiply<B>(&inverse_[i * B * B], sum, &x[i * B]);
  }
}

/// After the forward sweep b - A x = D (C - 1) x - (L^T + O) x.
template <int B>
void GaussSeidel::defect_after_forward(std::span<const Real> x, std::span<Real> r, Index begin,
                                       Index end) const {
  const SparsityPattern& p = *pattern_;
  for (auto i = at(begin); i < at(end); ++i) {
    const auto diagonal = at(p.diagonal[i]);
    Real sum[B];
    multiply<B>(&values_[diagonal * B * B], &x[i * B], sum);
    for (int k = 0; k < B; ++k) sum[k] *= excess_[i];
    for (auto e = at(p.offsets[i]); e < diagonal && p.columns[e] < begin; ++e) {
      multiply_subtract<B>(&values_[e * B * B], &x[at(p.columns[e]) * B], sum);
    }
    for (auto e = diagonal + 1; e < at(p.offsets[i + 1]); ++e) {
      multiply_subtract<B>(&values_[e * B * B], &x[at(p.columns[e]) * B], sum);
    }
    std::copy_n(sum, B, &r[i * B]);
  }
}

template <int B>
void GaussSeidel::backward_rows(std::span<const Real> b, std::span<const Real> before,
                                std::span<Real> x, Index begin, Index end) const {
  const SparsityPattern& p = *pattern_;
  for (auto i = at(end); i-- > at(begin);) {
    Real sum[B], step[B];
    std::copy_n(&b[i * B], B, sum);
    for (auto e = at(p.offsets[i]); e < at(p.offsets[i + 1]); ++e) {
      const Index j = p.columns[e];
      // Other runs are at work on theirs.
      const Real* other = j >= begin && j < end ? x.data() : before.data();
      multiply_subtract<B>(&values_[e * B * B], other + at(j) * B, sum);
    }
    multiply<B>(&inverse_[i * B * B], sum, step);
    for (int k = 0; k < B; ++k) x[i * B + at(k)] += step[k];
  }
}

void GaussSeidel::forward(std::span<const Real> b, std::span<Real> x, std::span<Real> r,
                          int threads) const {
  with_block(block_, [&](auto size) {
    const Index n = pattern_->rows();
    parallel_for(worthwhile(threads, values_.size()), n,
                 [&](Index begin, Index end) { forward_rows<size()>(b, x, begin, end); });
    parallel_for(worthwhile(threads, values_.size()), n,
                 [&](Index begin, Index end) { defect_after_forward<size()>(x, r, begin, end); });
  });
}

void GaussSeidel::backward(std::span<const Real> b, std::span<const Real> before, std::span<Real> x,
                           int threads) const {
  with_block(block_, [&](auto size) {
    parallel_for(worthwhile(threads, values_.size()), pattern_->rows(),
                 [&](Index begin, Index end) { backward_rows<size()>(b, before, x, begin, end); });
  });
}

void GaussSeidel::defect(std::span<const Real> b, std::span<const Real> x, std::span<Real> r,
                         int threads) const {
  const SparsityPattern& p = *pattern_;
  with_block(block_, [&](auto size) {
    constexpr int B = size();
    parallel_for(worthwhile(threads, values_.size()), p.rows(), [&](Index begin, Index end) {
      for (auto i = at(begin); i < at(end); ++i) {
        Real sum[B];
        std::copy_n(&b[i * B], B, sum);
        for (auto e = at(p.offsets[i]); e < at(p.offsets[i + 1]); ++e) {
          multiply_subtract<B>(&values_[e * B * B], &x[at(p.columns[e]) * B], sum);
        }
        std::copy_n(sum, B, &r[i * B]);
      }
    });
  });
}

}  // namespace winslow
