#include "core/linear/multigrid.h"

#include <Eigen/Cholesky>
#include <cmath>
#include <deque>
#include <optional>

#include "core/error.h"
#include "core/linear/smoothed_aggregation.h"
#include "core/linear/vector_operations.h"
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

/// Weight of a row's connections to other runs relative to the diagonal: the sum of the Frobenius
/// norms of D_i^-1/2 A_ij D_j^-1/2 over the columns outside [begin, end).
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

/// visit(size of blocks as a constant, first row, end) for each run of rows, on several threads.
template <typename Visit>
void GaussSeidel::each_run(int threads, Visit&& visit) const {
  with_block(block_, [&](auto size) {
    parallel_for(worthwhile(threads, values_.size()), pattern_->rows(),
                 [&](Index begin, Index end) { visit(size, begin, end); });
  });
}

/// The same with the numbers a row of vectors as a second constant.
template <typename Visit>
void GaussSeidel::each_run_of_vectors(int threads, Visit&& visit) const {
  const auto numbers = at(width_) * values_.size();
  with_shape(block_, width_, [&](auto size, auto count) {
    parallel_for(worthwhile(threads, numbers), pattern_->rows(),
                 [&](Index begin, Index end) { visit(size, count, begin, end); });
  });
}

void GaussSeidel::build(const SparseMatrix& matrix, int threads, int width) {
  pattern_ = matrix.pattern;
  block_ = matrix.block;
  width_ = width;
  const auto rows = at(pattern_->rows());
  values_.resize(matrix.values.size());
  inverse_.resize(rows * at(block_) * at(block_));
  excess_.resize(rows);
  inside_.resize(2 * rows);
  each_run(threads,
           [&](auto size, Index begin, Index end) { build_rows<size()>(matrix, begin, end); });
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

template <int B, int N>
void GaussSeidel::product(Index first, Index last, std::span<const Real> x, Real* out) const {
  if constexpr (N == B)
    row_product<B>(values_.data(), pattern_->columns.data(), first, last, x.data(), out);
  else
    wide_row_product(values_.data(), pattern_->columns.data(), first, last, x.data(), out);
}

template <int B, int N>
void GaussSeidel::forward_rows(std::span<const Real> b, std::span<Real> x, Index begin,
                               Index end) const {
  for (auto i = at(begin); i < at(end); ++i) {
    Real sum[N];
    product<B, N>(inside_[2 * i], pattern_->diagonal[i], x, sum);
    for (std::size_t k = 0; k < N; ++k) sum[k] = b[i * N + k] - sum[k];
    multiply_row<B, N>(&inverse_[i * B * B], sum, &x[i * N]);
  }
}

/// After the forward sweep b - A x = D (C - 1) x - (L^T + O) x.
template <int B, int N>
void GaussSeidel::defect_after_forward(std::span<const Real> x, std::span<Real> r, Index begin,
                                       Index end) const {
  const SparsityPattern& p = *pattern_;
  for (auto i = at(begin); i < at(end); ++i) {
    Real sum[N], before[N], after[N];
    product<B, N>(p.diagonal[i], p.diagonal[i] + 1, x, sum);
    product<B, N>(p.offsets[i], inside_[2 * i], x, before);
    product<B, N>(p.diagonal[i] + 1, p.offsets[i + 1], x, after);
    for (std::size_t k = 0; k < N; ++k) r[i * N + k] = excess_[i] * sum[k] - before[k] - after[k];
  }
}

template <int B, int N>
void GaussSeidel::backward_rows(std::span<const Real> b, std::span<const Real> before,
                                std::span<Real> x, Index begin, Index end) const {
  const SparsityPattern& p = *pattern_;
  for (auto i = at(end); i-- > at(begin);) {
    Real inside[N], first[N], last[N], step[N];
    product<B, N>(inside_[2 * i], inside_[2 * i + 1], x, inside);
    // Other threads may be changing x in other runs.
    product<B, N>(p.offsets[i], inside_[2 * i], before, first);
    product<B, N>(inside_[2 * i + 1], p.offsets[i + 1], before, last);
    for (std::size_t k = 0; k < N; ++k) inside[k] = b[i * N + k] - first[k] - inside[k] - last[k];
    multiply_row<B, N>(&inverse_[i * B * B], inside, step);
    for (std::size_t k = 0; k < N; ++k) x[i * N + k] += step[k];
  }
}

void GaussSeidel::forward(std::span<const Real> b, std::span<Real> x, std::span<Real> r,
                          int threads) const {
  each_run_of_vectors(threads, [&](auto size, auto count, Index begin, Index end) {
    forward_rows<size(), count()>(b, x, begin, end);
  });
  each_run_of_vectors(threads, [&](auto size, auto count, Index begin, Index end) {
    defect_after_forward<size(), count()>(x, r, begin, end);
  });
}

void GaussSeidel::backward(std::span<const Real> b, std::span<const Real> before, std::span<Real> x,
                           int threads) const {
  each_run_of_vectors(threads, [&](auto size, auto count, Index begin, Index end) {
    backward_rows<size(), count()>(b, before, x, begin, end);
  });
}

void GaussSeidel::defect(std::span<const Real> b, std::span<const Real> x, std::span<Real> r,
                         int threads) const {
  const SparsityPattern& p = *pattern_;
  each_run_of_vectors(threads, [&](auto size, auto count, Index begin, Index end) {
    constexpr std::size_t N = count();
    for (auto i = at(begin); i < at(end); ++i) {
      Real sum[N];
      product<size(), count()>(p.offsets[i], p.offsets[i + 1], x, sum);
      for (std::size_t k = 0; k < N; ++k) r[i * N + k] = b[i * N + k] - sum[k];
    }
  });
}

namespace {

/// Largest number of block rows of a level that is solved by dense Cholesky.
constexpr Index dense_rows = 100;
/// Entries weaker than this are not used for interpolation; halved at every level, as stencils
/// widen.
constexpr double finest_strength = 0.04;

struct Level {
  SparseMatrix own;  // the matrix; unused on the finest level
  GaussSeidel smoother;
  std::optional<Prolongation> prolongation;  // from the next level, if there is one
  Eigen::LLT<Eigen::MatrixXd> dense;         // of the last level, if it is small
  std::vector<Real> b, x, r, before, first_visit;
};

Eigen::MatrixXd dense_matrix(const SparseMatrix& matrix) {
  const SparsityPattern& p = *matrix.pattern;
  const Eigen::Index block = matrix.block;
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(matrix.rows(), matrix.rows());
  for (Index i = 0; i < p.rows(); ++i) {
    for (auto e = at(p.offsets[at(i)]); e < at(p.offsets[at(i) + 1]); ++e) {
      for (Eigen::Index k = 0; k < block * block; ++k) {
        result(i * block + k / block, p.columns[e] * block + k % block) =
            matrix.values[e * at(matrix.block * matrix.block) + static_cast<std::size_t>(k)];
      }
    }
  }
  return result;
}

class Multigrid final : public Preconditioner {
 public:
  /// components: right-hand sides, 1, or 3 for scalar matrices. Inside, three are four numbers
  /// wide.
  Multigrid(int threads, std::size_t components)
      : threads_(threads), components_(components), width_(components == 1 ? 1 : 4) {}

  std::string description() const override {
    const std::string levels =
        levels_.empty() ? "" : " (" + std::to_string(levels_.size()) + " levels)";
    return "smoothed aggregation multigrid" + levels;
  }

  std::size_t bytes() const override {
    std::size_t sum = 0;
    for (const Level& level : levels_) {
      sum += bytes_of(level.own.values) + bytes_of(level.own.pattern) + level.smoother.bytes() +
             bytes_of(level.b, level.x, level.r, level.before, level.first_visit) +
             static_cast<std::size_t>(level.dense.rows() * level.dense.cols()) * sizeof(double);
      if (level.prolongation) sum += level.prolongation->bytes();
    }
    return sum;
  }

  void build(const SparseMatrix& finest) override {
    if (width_ != 1 && finest.block != 1)
      throw UsageError("multigrid of components takes scalar matrices only");
    const bool fresh = pattern_ != finest.pattern || block_ != finest.block;
    if (fresh) {
      levels_.clear();
      levels_.emplace_back();
    }
    pattern_ = nullptr;  // until the build succeeds
    double strength = finest_strength;
    for (std::size_t l = 0; build_level(l, finest, fresh, strength); ++l) strength /= 2;
    pattern_ = finest.pattern;
    block_ = finest.block;
  }

  void apply(std::span<const double> r, std::span<double> z) override {
    Level& finest = levels_.front();
    // Scaling by a power of two brings the numbers into the range of single precision without
    // rounding.
    double largest = 0;
    for (const double v : r) largest = std::max(largest, std::abs(v));
    const double scale =
        largest > 0 && std::isfinite(largest) ? std::exp2(-std::ilogb(largest)) : 1;
    const auto n = static_cast<Index>(r.size() / components_);
    const auto each_number = [&](auto&& visit) {
      parallel_for(worthwhile(threads_, r.size()), n, [&](Index begin, Index end) {
        for (auto i = at(begin); i < at(end); ++i)
          for (std::size_t k = 0; k < components_; ++k)
            visit(components_ * i + k, at(width_) * i + k);
      });
    };
    each_number(
        [&](std::size_t i, std::size_t to) { finest.b[to] = static_cast<Real>(r[i] * scale); });
    cycle(0);
    each_number([&](std::size_t i, std::size_t from) {
      z[i] = static_cast<double>(finest.x[from]) / scale;
    });
  }

 private:
  /// Returns true if there is a coarser level.
  bool build_level(std::size_t l, const SparseMatrix& finest, bool fresh, double strength) {
    Level& level = levels_[l];
    const SparseMatrix& matrix = l == 0 ? finest : level.own;
    for (auto* v : {&level.b, &level.x, &level.r, &level.before, &level.first_visit}) {
      v->resize(at(width_) * at(matrix.rows()));
    }
    if (matrix.pattern->rows() <= dense_rows) {
      level.dense.compute(dense_matrix(matrix));
      if (level.dense.info() != Eigen::Success) {
        throw NotPositiveDefinite("the matrix is not positive definite (coarsest level)");
      }
      return false;
    }
    level.smoother.build(matrix, threads_, width_);
    if (fresh) {
      Prolongation prolongation(matrix, strength);
      const Index coarse = prolongation.coarse_rows();
      constexpr double least_coarsening = 0.9;
      if (coarse > 0 && coarse < least_coarsening * matrix.pattern->rows()) {
        level.prolongation = std::move(prolongation);
        levels_.emplace_back();
      }
    }
    if (!level.prolongation) return false;
    level.prolongation->build(matrix, threads_);
    level.prolongation->galerkin(matrix, levels_[l + 1].own, threads_);
    return true;
  }

  /// x = M^-1 b on level l.
  void cycle(std::size_t l) {
    Level& level = levels_[l];
    if (level.dense.rows() > 0) {
      using Column = Eigen::VectorX<Real>;
      const Eigen::InnerStride<> stride(width_);
      for (int k = 0; k < width_; ++k) {
        const Eigen::Map<const Column, 0, Eigen::InnerStride<>> b(level.b.data() + k,
                                                                  level.dense.rows(), stride);
        Eigen::Map<Column, 0, Eigen::InnerStride<>>(level.x.data() + k, level.dense.rows(),
                                                    stride) =
            level.dense.solve(b.cast<double>()).cast<Real>();
      }
      return;
    }
    level.smoother.forward(level.b, level.x, level.r, threads_);
    if (level.prolongation) {
      Level& coarse = levels_[l + 1];
      level.prolongation->restrict(level.r, coarse.b, threads_, width_);
      visit_twice(l + 1);
      level.prolongation->prolong(coarse.x, level.x, level.before, threads_, width_);
    } else {
      level.before = level.x;
    }
    level.smoother.backward(level.b, level.before, level.x, threads_);
  }

  /// A second cycle on the remaining residual (W-cycle). It is cheap because coarsening is fast,
  /// and it keeps the iteration count independent of the number of levels.
  void visit_twice(std::size_t l) {
    cycle(l);
    Level& level = levels_[l];
    if (level.dense.rows() > 0) return;
    level.smoother.defect(level.b, level.x, level.b, threads_);
    level.first_visit = level.x;
    cycle(l);
    for (std::size_t i = 0; i < level.x.size(); ++i) level.x[i] += level.first_visit[i];
  }

  int threads_;
  std::size_t components_;
  int width_;
  std::shared_ptr<const SparsityPattern> pattern_;  // of the hierarchy
  int block_ = 0;
  std::deque<Level> levels_;
};

}  // namespace

std::unique_ptr<Preconditioner> make_multigrid(int threads) {
  return std::make_unique<Multigrid>(threads, std::size_t{1});
}

std::unique_ptr<Preconditioner> make_multigrid_of_components(int threads) {
  return std::make_unique<Multigrid>(threads, std::size_t{3});
}

}  // namespace winslow
