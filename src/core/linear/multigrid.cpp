#include "core/linear/multigrid.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "core/error.h"
#include "core/linear/gauss_seidel.h"
#include "core/linear/prolongation.h"
#include "core/linear/worthwhile.h"
#include "core/parallel/parallel_for.h"

namespace winslow {

namespace {

/// Rows of blocks at and below which a level is solved by dense Cholesky.
constexpr Index dense_rows = 100;
/// Entries weaker than this do not interpolate; halved from level to level, as stencils widen.
constexpr double finest_strength = 0.04;

struct Level {
  SparseMatrix own;  // the matrix, of all levels but the finest
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
  explicit Multigrid(int threads) : threads_(threads) {}

  std::string description() const override {
    const std::string levels =
        levels_.empty() ? "" : " (" + std::to_string(levels_.size()) + " levels)";
    return "smoothed aggregation multigrid" + levels;
  }

  void build(const SparseMatrix& finest) override {
    const bool fresh = pattern_ != finest.pattern || block_ != finest.block;
    if (fresh) {
      levels_.clear();
      levels_.emplace_back();
    }
    pattern_ = nullptr;  // until all is well
    double strength = finest_strength;
    for (std::size_t l = 0; build_level(l, finest, fresh, strength); ++l) strength /= 2;
    pattern_ = finest.pattern;
    block_ = finest.block;
  }

  void apply(std::span<const double> r, std::span<double> z) override {
    Level& finest = levels_.front();
    // A power of two brings the numbers into the range of single precision, and changes no digit.
    double largest = 0;
    for (const double v : r) largest = std::max(largest, std::abs(v));
    const double scale =
        largest > 0 && std::isfinite(largest) ? std::exp2(-std::ilogb(largest)) : 1;
    const auto n = static_cast<Index>(r.size());
    parallel_for(worthwhile(threads_, r.size()), n, [&](Index begin, Index end) {
      for (auto i = at(begin); i < at(end); ++i) finest.b[i] = static_cast<Real>(r[i] * scale);
    });
    cycle(0);
    parallel_for(worthwhile(threads_, r.size()), n, [&](Index begin, Index end) {
      for (auto i = at(begin); i < at(end); ++i) z[i] = static_cast<double>(finest.x[i]) / scale;
    });
  }

 private:
  /// Returns true if there is a coarser level.
  bool build_level(std::size_t l, const SparseMatrix& finest, bool fresh, double strength) {
    Level& level = levels_[l];
    const SparseMatrix& matrix = l == 0 ? finest : level.own;
    for (auto* v : {&level.b, &level.x, &level.r, &level.before, &level.first_visit}) {
      v->resize(at(matrix.rows()));
    }
    if (matrix.pattern->rows() <= dense_rows) {
      level.dense.compute(dense_matrix(matrix));
      if (level.dense.info() != Eigen::Success) {
        throw NotPositiveDefinite("the matrix is not positive definite (coarsest level)");
      }
      return false;
    }
    level.smoother.build(matrix, threads_);
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
      const auto n = static_cast<Eigen::Index>(level.b.size());
      const Eigen::Map<const Eigen::VectorX<Real>> b(level.b.data(), n);
      Eigen::Map<Eigen::VectorX<Real>>(level.x.data(), n) =
          level.dense.solve(b.cast<double>()).cast<Real>();
      return;
    }
    level.smoother.forward(level.b, level.x, level.r, threads_);
    if (level.prolongation) {
      Level& coarse = levels_[l + 1];
      level.prolongation->restrict(level.r, coarse.b, threads_);
      visit_twice(l + 1);
      level.prolongation->prolong(coarse.x, level.x, level.before, threads_);
    } else {
      level.before = level.x;
    }
    level.smoother.backward(level.b, level.before, level.x, threads_);
  }

  /// A second cycle on what the first has left over. Coarsening is so fast that it costs little,
  /// and it keeps the iterations from growing with the number of levels.
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
  std::shared_ptr<const SparsityPattern> pattern_;  // of the hierarchy
  int block_ = 0;
  std::deque<Level> levels_;
};

}  // namespace

std::unique_ptr<Preconditioner> make_multigrid(int threads) {
  return std::make_unique<Multigrid>(threads);
}

}  // namespace winslow
