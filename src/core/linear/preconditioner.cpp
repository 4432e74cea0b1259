#include "core/linear/preconditioner.h"

#include <Eigen/IterativeLinearSolvers>

#include "core/error.h"
#include "core/linear/blocks.h"
#include "core/linear/factorisation.h"
#include "core/linear/smoothed_aggregation.h"
#include "core/linear/vector_operations.h"
#include "core/parallel/parallel_for.h"

namespace winslow {

namespace {

template <int B>
Eigen::Map<Block<double, B>> block(std::vector<double>& values, std::size_t k) {
  return Eigen::Map<Block<double, B>>(&values[k * B * B]);
}
template <int B>
Eigen::Map<const Block<double, B>> block(const std::vector<double>& values, std::size_t k) {
  return Eigen::Map<const Block<double, B>>(&values[k * B * B]);
}

/// L D L^T, L with unit diagonal and the pattern of the matrix within runs.
class IncompleteCholesky final : public Preconditioner {
 public:
  explicit IncompleteCholesky(int threads) : threads_(threads) {}

  std::string description() const override { return "incomplete Cholesky IC(0)"; }
  std::size_t bytes() const override { return bytes_of(lower_, inverse_pivot_); }

  void build(const SparseMatrix& matrix) override {
    pattern_ = matrix.pattern;
    block_ = matrix.block;
    lower_.resize(matrix.values.size());
    inverse_pivot_.resize(at(matrix.rows()) * at(matrix.block));
    with_block(block_, [&](auto size) {
      parallel_for(worthwhile(threads_, lower_.size()), pattern_->rows(),
                   [&](Index begin, Index end) { factorise_run<size()>(matrix, begin, end); });
    });
  }

  void apply(std::span<const double> r, std::span<double> z) override {
    with_block(block_, [&](auto size) {
      parallel_for(worthwhile(threads_, lower_.size()), pattern_->rows(),
                   [&](Index begin, Index end) { solve_run<size()>(r, z, begin, end); });
    });
  }

 private:
  /// First entry of a row within the run that starts at row `begin`.
  std::size_t first_inside(std::size_t row, Index begin) const {
    const auto first = pattern_->columns.begin() + pattern_->offsets[row];
    const auto last = pattern_->columns.begin() + pattern_->diagonal[row];
    return static_cast<std::size_t>(std::lower_bound(first, last, begin) -
                                    pattern_->columns.begin());
  }

  template <int B>
  void factorise_run(const SparseMatrix& matrix, Index begin, Index end) {
    for (auto i = at(begin); i < at(end); ++i) {
      const auto first = first_inside(i, begin), diagonal = at(pattern_->diagonal[i]);
      std::copy_n(&matrix.values[first * B * B], (diagonal - first) * B * B,
                  &lower_[first * B * B]);
      for (auto e = first; e < diagonal; ++e) eliminate<B>(first, e, begin);
      const Block<double, B> original = block<B>(matrix.values, diagonal);
      Block<double, B> pivot = original;
      for (auto e = first; e < diagonal; ++e) {
        auto l = block<B>(lower_, e);
        const Block<double, B> times_pivot = l;
        l = times_pivot * block<B>(inverse_pivot_, at(pattern_->columns[e]));
        pivot -= times_pivot * l.transpose();
      }
      block<B>(inverse_pivot_, i) = safe_pivot<B>(pivot, original).inverse();
    }
  }

  /// Updates entry e of a row, in column k: subtracts the product of the row (so far L D) and row k
  /// (L) over the columns before k.
  template <int B>
  void eliminate(std::size_t first, std::size_t e, Index begin) {
    const SparsityPattern& p = *pattern_;
    const auto k = at(p.columns[e]);
    auto f = first_inside(k, begin);
    for (auto m = first; m < e; ++m) {
      while (f < at(p.diagonal[k]) && p.columns[f] < p.columns[m]) ++f;
      if (f == at(p.diagonal[k])) break;
      if (p.columns[f] == p.columns[m]) {
        block<B>(lower_, e) -= block<B>(lower_, m) * block<B>(lower_, f).transpose();
      }
    }
  }

  template <int B>
  static Block<double, B> safe_pivot(const Block<double, B>& pivot,
                                     const Block<double, B>& original) {
    constexpr double safe = 0.02;
    const double smallest = smallest_eigenvalue<B>(original);
    if (!(smallest > 0)) {
      throw NotPositiveDefinite("the matrix is not positive definite (a block on its diagonal)");
    }
    return smallest_eigenvalue<B>(pivot) > safe * smallest ? pivot : original;
  }

  template <int B>
  void solve_run(std::span<const double> r, std::span<double> z, Index begin, Index end) const {
    const SparsityPattern& p = *pattern_;
    for (auto i = at(begin); i < at(end); ++i) {
      std::copy_n(&r[i * B], B, &z[i * B]);
      for (auto e = first_inside(i, begin); e < at(p.diagonal[i]); ++e) {
        multiply_subtract<B>(&lower_[e * B * B], &z[at(p.columns[e]) * B], &z[i * B]);
      }
    }
    for (auto i = at(begin); i < at(end); ++i) {
      double scaled[B];
      multiply<B>(&inverse_pivot_[i * B * B], &z[i * B], scaled);
      std::copy_n(scaled, B, &z[i * B]);
    }
    for (auto i = at(end); i-- > at(begin);) {
      for (auto e = first_inside(i, begin); e < at(p.diagonal[i]); ++e) {
        subtract_transposed<B>(&lower_[e * B * B], &z[i * B], &z[at(p.columns[e]) * B]);
      }
    }
  }

  int threads_;
  std::shared_ptr<const SparsityPattern> pattern_;
  int block_ = 1;
  std::vector<double> lower_;          // #entries; those of L within runs are set
  std::vector<double> inverse_pivot_;  // D^-1, row by row
};

}  // namespace

std::unique_ptr<Preconditioner> make_incomplete_cholesky(int threads) {
  return std::make_unique<IncompleteCholesky>(threads);
}

namespace {

class IncompleteLu final : public Preconditioner {
 public:
  IncompleteLu() {
    ilut_.setDroptol(1e-3);
    ilut_.setFillfactor(10);
  }

  std::string description() const override { return "incomplete LU (ILUT)"; }
  /// Eigen does not say how large its factors are: as large as their fill allows.
  std::size_t bytes() const override {
    constexpr std::size_t fill = 10, entry = sizeof(double) + sizeof(Index);
    return matrix_.bytes() + fill * entry * static_cast<std::size_t>(matrix_.matrix().nonZeros());
  }

  void build(const SparseMatrix& matrix) override {
    if (matrix_.assign(matrix)) {
      // Not analyzePattern(): it would read a status that Eigen's ILUT has not set yet.
      ilut_.compute(matrix_.matrix());
    } else {
      ilut_.factorize(matrix_.matrix());
    }
    if (ilut_.info() != Eigen::Success) {
      throw NumericError("the linear system is singular (incomplete LU failed)");
    }
  }

  void apply(std::span<const double> r, std::span<double> z) override {
    const auto n = static_cast<Eigen::Index>(r.size());
    Eigen::Map<Eigen::VectorXd>(z.data(), n) =
        ilut_.solve(Eigen::Map<const Eigen::VectorXd>(r.data(), n));
  }

 private:
  EigenMatrix matrix_{EigenMatrix::Part::all};
  Eigen::IncompleteLUT<double> ilut_;
};

}  // namespace

std::unique_ptr<Preconditioner> make_incomplete_lu() { return std::make_unique<IncompleteLu>(); }

void ReorderedMatrix::assign(const SparseMatrix& source, int threads) {
  if (source_pattern_ != source.pattern) adopt(source.pattern);
  matrix_.block = source.block;
  matrix_.symmetric = source.symmetric;
  matrix_.values.resize(source.values.size());
  with_block(source.block, [&](auto block) {
    constexpr std::size_t size = block() * block();  // known, so that no function is called to copy
    const auto entries = static_cast<Index>(source_entry_.size());
    parallel_for(worthwhile(threads, source.values.size()), entries, [&](Index begin, Index end) {
      for (auto e = at(begin); e < at(end); ++e)
        std::memcpy(&matrix_.values[e * size], &source.values[at(source_entry_[e]) * size],
                    size * sizeof(double));
    });
  });
}

void ReorderedMatrix::adopt(std::shared_ptr<const SparsityPattern> pattern) {
  source_pattern_ = std::move(pattern);
  const SparsityPattern& p = *source_pattern_;
  order_ = locality_ordering(p);
  std::vector<Index> place(order_.size());
  for (std::size_t k = 0; k < order_.size(); ++k) place[at(order_[k])] = static_cast<Index>(k);
  auto built = std::make_shared<SparsityPattern>();
  built->offsets.reserve(p.offsets.size());
  built->columns.reserve(p.columns.size());
  built->diagonal.reserve(p.diagonal.size());
  source_entry_.clear();
  source_entry_.reserve(p.columns.size());
  std::vector<std::pair<Index, Index>> row;  // column and entry
  for (std::size_t k = 0; k < order_.size(); ++k) {
    row.clear();
    const auto i = at(order_[k]);
    for (Index e = p.offsets[i]; e < p.offsets[i + 1]; ++e) {
      row.emplace_back(place[at(p.columns[at(e)])], e);
    }
    std::sort(row.begin(), row.end());
    for (const auto& [column, entry] : row) {
      if (column == static_cast<Index>(k)) {
        built->diagonal.push_back(static_cast<Index>(built->columns.size()));
      }
      built->columns.push_back(column);
      source_entry_.push_back(entry);
    }
    built->offsets.push_back(static_cast<Index>(built->columns.size()));
  }
  matrix_.pattern = std::move(built);
}

void ReorderedMatrix::gather(std::span<const double> source, int columns, int column,
                             std::span<double> vector) const {
  const auto block = at(matrix_.block), stride = at(columns);
  for (std::size_t k = 0; k < order_.size(); ++k) {
    for (std::size_t r = 0; r < block; ++r) {
      vector[k * block + r] = source[(at(order_[k]) * block + r) * stride + at(column)];
    }
  }
}

void ReorderedMatrix::scatter(std::span<const double> vector, int columns, int column,
                              std::span<double> target) const {
  const auto block = at(matrix_.block), stride = at(columns);
  for (std::size_t k = 0; k < order_.size(); ++k) {
    for (std::size_t r = 0; r < block; ++r) {
      target[(at(order_[k]) * block + r) * stride + at(column)] = vector[k * block + r];
    }
  }
}

}  // namespace winslow
