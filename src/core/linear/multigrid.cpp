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

/// The inverse of the Cholesky factor of a block on the diagonal.
template <int B>
Eigen::Matrix<double, B, B> inverse_factor(const SparseMatrix& matrix, Index row) {
  const auto d = block_at<B>(matrix, at(matrix.pattern->diagonal[at(row)]));
  const Eigen::LLT<Eigen::Matrix<double, B, B>> llt(d);
  if (llt.info() != Eigen::Success || !(d.diagonal().minCoeff() > 0)) {
    throw NotPositiveDefinite("the matrix is not positive definite (a block on its diagonal)");
  }
  return llt.matrixL().solve(Eigen::Matrix<double, B, B>::Identity());
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
  const auto rows = at(pattern_->rows()), size = at(block_) * at(block_);
  values_.resize(matrix.values.size() + block_tail);
  inverse_.resize(rows * size + block_tail);
  excess_.resize(rows);
  inside_.resize(2 * rows);
  std::vector<double> inverse_factors(rows * size);
  each_run(threads, [&](auto block, Index begin, Index end) {
    factor_rows<block()>(matrix, begin, end, inverse_factors);
  });
  each_run(threads, [&](auto block, Index begin, Index end) {
    build_rows<block()>(matrix, inverse_factors, begin, end);
  });
}

/// Finds the inverses of the Cholesky factors on the diagonal, row-major, for build_rows().
template <int B>
void GaussSeidel::factor_rows(const SparseMatrix& matrix, Index begin, Index end,
                              std::span<double> inverse_factors) {
  for (Index i = begin; i < end; ++i) {
    Eigen::Map<Block<double, B>> target(&inverse_factors[at(i) * B * B]);
    target = inverse_factor<B>(matrix, i);
  }
}

template <int B>
void GaussSeidel::build_rows(const SparseMatrix& matrix, std::span<const double> inverse_factors,
                             Index begin, Index end) {
  using Matrix = Eigen::Matrix<double, B, B>;
  const SparsityPattern& p = *pattern_;
  const auto factor = [&](Index row) {
    return Eigen::Map<const Block<double, B>>(&inverse_factors[at(row) * B * B]);
  };
  for (Index i = begin; i < end; ++i) {
    const auto first = at(p.offsets[at(i)]), last = at(p.offsets[at(i) + 1]);
    for (auto e = first; e < last; ++e) {
      Eigen::Map<Eigen::Matrix<Real, B, B>> target(&values_[e * B * B]);
      target = block_at<B>(matrix, e).template cast<Real>();
    }
    const auto columns = p.columns.begin();
    const auto of_row = [&](Index column) {
      return static_cast<Index>(
          std::lower_bound(columns + p.offsets[at(i)], columns + p.offsets[at(i) + 1], column) -
          columns);
    };
    inside_[2 * at(i)] = of_row(begin);
    inside_[2 * at(i) + 1] = of_row(end);
    // Weight of the connections to other runs relative to the diagonal: the sum of the Frobenius
    // norms of D_i^-1/2 A_ij D_j^-1/2.
    double outside = 0;
    const auto add_outside = [&](std::size_t e) {
      const Matrix scaled = factor(i) * block_at<B>(matrix, e) * factor(p.columns[e]).transpose();
      outside += scaled.norm();
    };
    for (auto e = first; e < at(inside_[2 * at(i)]); ++e) add_outside(e);
    for (auto e = at(inside_[2 * at(i) + 1]); e < last; ++e) add_outside(e);
    // M + M^T - A = D (2 C - 1) - O is positive definite if 2 C - 1 exceeds the weight of O.
    constexpr double margin = 0.9;
    const double excess = std::max(0.0, (outside - margin) / 2);
    excess_[at(i)] = static_cast<Real>(excess);
    const Matrix inverse = factor(i).transpose() * factor(i) / (1 + excess);
    Eigen::Map<Eigen::Matrix<Real, B, B>> target(&inverse_[at(i) * B * B]);
    target = inverse.template cast<Real>();
  }
}

template <int B, int N>
void GaussSeidel::forward_rows(std::span<const Real> b, std::span<Real> x, Index begin,
                               Index end) const {
  for (auto i = at(begin); i < at(end); ++i) {
    BlockSum<B, N> sum;
    add(inside_[2 * i], pattern_->diagonal[i], x, sum);
    const Row<N> rest = load_row<N>(&b[i * N]) - sum.total();
    store_row<N>(block_times<B, N>(&inverse_[i * B * B], rest), &x[i * N]);
  }
}

/// After the forward sweep b - A x = D (C - 1) x - (L^T + O) x.
template <int B, int N>
void GaussSeidel::defect_after_forward(std::span<const Real> x, std::span<Real> r, Index begin,
                                       Index end) const {
  const SparsityPattern& p = *pattern_;
  for (auto i = at(begin); i < at(end); ++i) {
    BlockSum<B, N> others;
    add(p.offsets[i], inside_[2 * i], x, others);
    add(p.diagonal[i] + 1, p.offsets[i + 1], x, others);
    Row<N> rest = -others.total();
    if (excess_[i] > 0)
      rest += excess_[i] *
              block_times<B, N>(&values_[at(p.diagonal[i]) * B * B], load_row<N>(&x[i * N]));
    store_row<N>(rest, &r[i * N]);
  }
}

template <int B, int N>
void GaussSeidel::backward_rows(std::span<const Real> b, std::span<const Real> before,
                                std::span<Real> x, Index begin, Index end) const {
  const SparsityPattern& p = *pattern_;
  for (auto i = at(end); i-- > at(begin);) {
    BlockSum<B, N> sum;
    // Other threads may be changing x in other runs.
    add(p.offsets[i], inside_[2 * i], before, sum);
    add(inside_[2 * i + 1], p.offsets[i + 1], before, sum);
    add(inside_[2 * i], inside_[2 * i + 1], x, sum);
    const Row<N> rest = load_row<N>(&b[i * N]) - sum.total();
    const Row<N> step = block_times<B, N>(&inverse_[i * B * B], rest);
    store_row<N>(load_row<N>(&x[i * N]) + step, &x[i * N]);
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
      BlockSum<size(), count()> sum;
      add(p.offsets[i], p.offsets[i + 1], x, sum);
      store_row<N>(load_row<N>(&b[i * N]) - sum.total(), &r[i * N]);
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
  /// components: right-hand sides, 1, or 3 for scalar matrices. Inside, three are four wide.
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

  Work work() const override {
    Work sum;
    double cycles = 1;
    for (const Level& level : levels_) {
      add_work(level, cycles, sum);
      cycles *= 2;
    }
    return sum;
  }

  void apply(std::span<const double> r, std::span<double> z) override {
    Level& finest = levels_.front();
    const std::size_t numbers = block_ == 1 ? components_ : at(block_);  // a row
    const std::size_t stride = at(row_stride(block_, width_));
    const auto n = static_cast<Index>(r.size() / numbers);
    // Scaling by a power of two brings the numbers into the range of single precision without
    // rounding.
    const double largest = largest_of(r);
    const double scale =
        largest > 0 && std::isfinite(largest) ? std::exp2(-std::ilogb(largest)) : 1;
    const auto each_number = [&](auto&& visit) {
      parallel_for(worthwhile(threads_, r.size()), n, [&](Index begin, Index end) {
        for (auto i = at(begin); i < at(end); ++i)
          for (std::size_t k = 0; k < numbers; ++k) visit(numbers * i + k, stride * i + k);
      });
    };
    each_number(
        [&](std::size_t i, std::size_t to) { finest.b[to] = static_cast<Real>(r[i] * scale); });
    cycle(0);
    const double back = 1 / scale;
    each_number([&](std::size_t i, std::size_t from) {
      z[i] = static_cast<double>(finest.x[from]) * back;
    });
  }

 private:
  /// Returns true if there is a coarser level.
  bool build_level(std::size_t l, const SparseMatrix& finest, bool fresh, double strength) {
    Level& level = levels_[l];
    const SparseMatrix& matrix = l == 0 ? finest : level.own;
    for (auto* v : {&level.b, &level.x, &level.r, &level.before, &level.first_visit}) {
      v->resize(at(row_stride(matrix.block, width_)) * at(matrix.pattern->rows()));
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
      solve_dense(level);
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

  /// Adds the work of some cycles on a level, and, below the finest one, of the defects between.
  void add_work(const Level& level, double cycles, Work& sum) const {
    const bool is_finest = &level == &levels_.front();
    const double size = static_cast<double>(block_) * block_;
    const double used = block_ == 1 ? static_cast<double>(components_) : 1;  // right-hand sides
    const double row_bytes = static_cast<double>(at(row_stride(block_, width_)) * sizeof(Real));
    const double dense = static_cast<double>(level.dense.rows());
    if (dense > 0) {
      sum.bytes += cycles * used * dense * dense * sizeof(double);
      sum.flops += cycles * used * 2 * dense * dense;
      return;
    }
    const SparsityPattern& p = is_finest ? *pattern_ : *level.own.pattern;
    const double rows = p.rows(), entries = static_cast<double>(p.columns.size());
    const double entry_bytes = size * sizeof(Real) + sizeof(Index);
    // Forward with its defect, and backward: the matrix once each; b, x, r and the copy of x.
    const double sweeps = 2 * cycles + (is_finest ? 0 : cycles / 2);
    sum.bytes += sweeps * (entries * entry_bytes + rows * (size * sizeof(Real) + 4 * row_bytes));
    sum.flops += sweeps * used * 2 * size * (entries + rows);
    if (!level.prolongation) return;
    const double of_p = static_cast<double>(level.prolongation->entries());
    sum.bytes += cycles * (2 * of_p * (entry_bytes + sizeof(Index)) + 4 * rows * row_bytes);
    sum.flops += cycles * used * 4 * size * of_p;
  }

  void solve_dense(Level& level) const {
    const std::size_t stride = at(row_stride(block_, width_)), block = at(block_);
    Eigen::VectorXd column(level.dense.rows());
    for (std::size_t k = 0; k < at(width_); ++k) {
      const auto each = [&](auto&& visit) {
        for (std::size_t i = 0; i < static_cast<std::size_t>(column.size()); ++i)
          visit(column[static_cast<Eigen::Index>(i)], stride * (i / block) + i % block + k);
      };
      each([&](double& v, std::size_t place) { v = static_cast<double>(level.b[place]); });
      level.dense.solveInPlace(column);
      each([&](double& v, std::size_t place) { level.x[place] = static_cast<Real>(v); });
    }
  }

  /// A second cycle on the remaining residual (W-cycle). It is cheap because coarsening is fast,
  /// and it keeps the iteration count independent of the number of levels.
  void visit_twice(std::size_t l) {
    cycle(l);
    Level& level = levels_[l];
    if (level.dense.rows() > 0) return;
    level.smoother.defect(level.b, level.x, level.b, threads_);
    std::swap(level.x, level.first_visit);
    cycle(l);
    for (std::size_t i = 0; i < level.x.size(); ++i) level.x[i] += level.first_visit[i];
  }

  /// The largest magnitude of some numbers.
  double largest_of(std::span<const double> r) const {
    std::vector<double> largest(block_count(static_cast<Index>(r.size())), 0.0);
    parallel_for(worthwhile(threads_, r.size()), static_cast<Index>(r.size()),
                 [&](Index begin, Index end) {
                   double most = 0;
                   for (auto i = at(begin); i < at(end); ++i) most = std::max(most, std::abs(r[i]));
                   largest[at(begin / parallel_block)] = most;
                 });
    return largest.empty() ? 0 : *std::ranges::max_element(largest);
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
