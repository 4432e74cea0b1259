#include "core/linear/prolongation.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/linear/blocks.h"
#include "core/linear/worthwhile.h"
#include "core/parallel/parallel_for.h"

namespace winslow {

namespace {

template <int B>
double norm(const SparseMatrix& matrix, std::size_t entry) {
  return Eigen::Map<const Block<double, B>>(&matrix.values[entry * B * B]).norm();
}

/// Inverse of a symmetric block if it is positive definite, by a safe margin against `scale`.
template <int B>
bool invert(const Block<double, B>& d, double scale, Block<double, B>& inverse) {
  constexpr double safe = 1e-2;
  if (!(smallest_eigenvalue<B>(d) > safe * scale)) return false;
  inverse = d.inverse();
  return true;
}

}  // namespace

Prolongation::Prolongation(const SparseMatrix& matrix, double strength)
    : block_(matrix.block), rows_(matrix.pattern->rows()) {
  choose_strong(matrix, strength);
  structure(*matrix.pattern, aggregate(*matrix.pattern, strong_));
}

void Prolongation::choose_strong(const SparseMatrix& matrix, double strength) {
  const SparsityPattern& p = *matrix.pattern;
  strong_.resize(p.columns.size());
  with_block(block_, [&](auto size) {
    constexpr int B = size();
    std::vector<double> diagonal(at(rows_));
    for (std::size_t i = 0; i < at(rows_); ++i) diagonal[i] = norm<B>(matrix, at(p.diagonal[i]));
    for (std::size_t i = 0; i < at(rows_); ++i) {
      for (auto e = at(p.offsets[i]); e < at(p.offsets[i + 1]); ++e) {
        const double size2 = norm<B>(matrix, e) * norm<B>(matrix, e);
        strong_[e] = size2 > strength * strength * diagonal[i] * diagonal[at(p.columns[e])];
      }
    }
  });
}

void Prolongation::structure(const SparsityPattern& pattern, const Aggregates& aggregates) {
  offsets_.assign(1, 0);
  columns_.clear();
  own_.assign(at(rows_), -1);
  entry_.assign(pattern.columns.size(), -1);
  for (std::size_t i = 0; i < at(rows_); ++i) {
    const auto first = static_cast<std::ptrdiff_t>(columns_.size());
    const Index own = aggregates.of_row[i];
    if (own >= 0) {
      for (auto e = at(pattern.offsets[i]); e < at(pattern.offsets[i + 1]); ++e) {
        const Index a = aggregates.of_row[at(pattern.columns[e])];
        if (!strong_[e] || a < 0) continue;
        const auto found = std::find(columns_.begin() + first, columns_.end(), a);
        entry_[e] = static_cast<Index>(found - columns_.begin());
        if (found == columns_.end()) columns_.push_back(a);
      }
      own_[i] = entry_[at(pattern.diagonal[i])];
    }
    offsets_.push_back(static_cast<Index>(columns_.size()));
  }
  transposed_offsets_.assign(at(aggregates.count) + 1, 0);
  transpose();
}

void Prolongation::transpose() {
  for (const Index a : columns_) ++transposed_offsets_[at(a) + 1];
  std::partial_sum(transposed_offsets_.begin(), transposed_offsets_.end(),
                   transposed_offsets_.begin());
  std::vector<Index> next(transposed_offsets_.begin(), transposed_offsets_.end() - 1);
  transposed_rows_.resize(columns_.size());
  transposed_entries_.resize(columns_.size());
  for (Index i = 0; i < rows_; ++i) {
    for (Index e = offsets_[at(i)]; e < offsets_[at(i) + 1]; ++e) {
      const auto slot = at(next[at(columns_[at(e)])]++);
      transposed_rows_[slot] = i;
      transposed_entries_[slot] = e;
    }
  }
}

void Prolongation::build(const SparseMatrix& matrix, int threads) {
  with_block(block_, [&](auto size) {
    values_.resize(columns_.size() * at(size() * size()));
    parallel_for(worthwhile(threads, matrix.values.size()), rows_,
                 [&](Index begin, Index end) { build_rows<size()>(matrix, begin, end); });
  });
}

template <int B>
void Prolongation::build_rows(const SparseMatrix& matrix, Index begin, Index end) {
  using Matrix = Block<double, B>;
  // Between 2/3, right for the Laplacian, and 1; measured on the Hessians of mesh energies.
  constexpr double omega = 0.8;
  const SparsityPattern& p = *matrix.pattern;
  const auto block = [&](std::size_t e) {
    return Eigen::Map<const Matrix>(&matrix.values[e * B * B]);
  };
  std::vector<Matrix, Eigen::aligned_allocator<Matrix>> row;
  for (auto i = at(begin); i < at(end); ++i) {
    if (own_[i] < 0) continue;
    const auto first = at(offsets_[i]);
    row.assign(at(offsets_[i + 1]) - first, Matrix::Zero());
    const auto diagonal = at(p.diagonal[i]);
    Matrix lumped = block(diagonal), inverse;
    for (auto e = at(p.offsets[i]); e < at(p.offsets[i + 1]); ++e) {
      if (!strong_[e]) lumped += block(e);
    }
    // Lumping can eat up the diagonal; then it is left out for this row.
    const double scale = block(diagonal).trace() / B;
    lumped = (0.5 * (lumped + lumped.transpose())).eval();
    if (!invert<B>(lumped, scale, inverse)) {
      lumped = block(diagonal);
      if (!invert<B>(lumped, 0, inverse)) inverse.setZero();
    }
    for (auto e = at(p.offsets[i]); e < at(p.offsets[i + 1]); ++e) {
      if (entry_[e] < 0) continue;
      const Matrix f = e == diagonal ? lumped : Matrix(block(e));
      row[at(entry_[e]) - first] -= omega * inverse * f;
    }
    row[at(own_[i]) - first] += Matrix::Identity();
    for (std::size_t k = 0; k < row.size(); ++k) {
      Eigen::Map<Block<Real, B>> target(&values_[(first + k) * B * B]);
      target = row[k].template cast<Real>();
    }
  }
}

void Prolongation::prolong(std::span<const Real> coarse, std::span<Real> x, std::span<Real> copy,
                           int threads) const {
  with_block(block_, [&](auto size) {
    constexpr int B = size();
    parallel_for(worthwhile(threads, values_.size()), rows_, [&](Index begin, Index end) {
      for (auto i = at(begin); i < at(end); ++i) {
        for (auto e = at(offsets_[i]); e < at(offsets_[i + 1]); ++e) {
          multiply_add<B>(&values_[e * B * B], &coarse[at(columns_[e]) * B], &x[i * B]);
        }
        std::copy_n(&x[i * B], B, &copy[i * B]);
      }
    });
  });
}

void Prolongation::restrict(std::span<const Real> r, std::span<Real> coarse, int threads) const {
  with_block(block_, [&](auto size) {
    constexpr std::size_t B = size();
    constexpr Index coarse_block = 256;  // there are few of these rows, and each takes long
    parallel_for(
        worthwhile(threads, values_.size()), coarse_rows(),
        [&](Index begin, Index end) {
          for (auto a = at(begin); a < at(end); ++a) {
            Real sum[B]{};
            for (auto t = at(transposed_offsets_[a]); t < at(transposed_offsets_[a + 1]); ++t) {
              const Real* p = &values_[at(transposed_entries_[t]) * B * B];
              const Real* from = &r[at(transposed_rows_[t]) * B];
              for (std::size_t k = 0; k < B; ++k) {
                for (std::size_t c = 0; c < B; ++c) sum[c] += p[k * B + c] * from[k];
              }
            }
            std::copy_n(sum, B, &coarse[a * B]);
          }
        },
        coarse_block);
  });
}

}  // namespace winslow
