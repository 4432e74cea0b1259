#include "core/linear/gauss_seidel.h"

#include <Eigen/Cholesky>
#include <algorithm>

#include "core/error.h"
#include "core/linear/blocks.h"
#include "core/linear/row_product.h"
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
  inside_.resize(2 * rows);
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
    const auto columns = pattern_->columns.begin();
    const auto first_entry = columns + pattern_->offsets[at(i)];
    const auto last_entry = columns + pattern_->offsets[at(i) + 1];
    inside_[2 * at(i)] =
        static_cast<Index>(std::lower_bound(first_entry, last_entry, begin) - columns);
    inside_[2 * at(i) + 1] =
        static_cast<Index>(std::lower_bound(first_entry, last_entry, end) - columns);
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
void GaussSeidel::product(Index first, Index last, std::span<const Real> x, Real* out) const {
  row_product<B>(values_.data(), pattern_->columns.data(), first, last, x.data(), out);
}

template <int B>
void GaussSeidel::forward_rows(std::span<const Real> b, std::span<Real> x, Index begin,
                               Index end) const {
  for (auto i = at(begin); i < at(end); ++i) {
    Real sum[B];
    product<B>(inside_[2 * i], pattern_->diagonal[i], x, sum);
    for (std::size_t k = 0; k < B; ++k) sum[k] = b[i * B + k] - sum[k];
    multiply<B>(&inverse_[i * B * B], sum, &x[i * B]);
  }
}

/// After the forward sweep b - A x = D (C - 1) x - (L^T + O) x.
template <int B>
void GaussSeidel::defect_after_forward(std::span<const Real> x, std::span<Real> r, Index begin,
                                       Index end) const {
  const SparsityPattern& p = *pattern_;
  for (auto i = at(begin); i < at(end); ++i) {
    Real sum[B], before[B], after[B];
    product<B>(p.diagonal[i], p.diagonal[i] + 1, x, sum);
    product<B>(p.offsets[i], inside_[2 * i], x, before);
    product<B>(p.diagonal[i] + 1, p.offsets[i + 1], x, after);
    for (std::size_t k = 0; k < B; ++k) r[i * B + k] = excess_[i] * sum[k] - before[k] - after[k];
  }
}

template <int B>
void GaussSeidel::backward_rows(std::span<const Real> b, std::span<const Real> before,
                                std::span<Real> x, Index begin, Index end) const {
  const SparsityPattern& p = *pattern_;
  for (auto i = at(end); i-- > at(begin);) {
    Real inside[B], first[B], last[B], step[B];
    product<B>(inside_[2 * i], inside_[2 * i + 1], x, inside);
    // Other runs are at work on theirs.
    product<B>(p.offsets[i], inside_[2 * i], before, first);
    product<B>(inside_[2 * i + 1], p.offsets[i + 1], before, last);
    for (std::size_t k = 0; k < B; ++k) inside[k] = b[i * B + k] - first[k] - inside[k] - last[k];
    multiply<B>(&inverse_[i * B * B], inside, step);
    for (std::size_t k = 0; k < B; ++k) x[i * B + k] += step[k];
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
        product<B>(p.offsets[i], p.offsets[i + 1], x, sum);
        for (std::size_t k = 0; k < B; ++k) r[i * B + k] = b[i * B + k] - sum[k];
      }
    });
  });
}

}  // namespace winslow
