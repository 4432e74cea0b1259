#include <algorithm>

#include "core/linear/block_kernel.h"
#include "core/linear/blocks.h"
#include "core/linear/prolongation.h"
#include "core/parallel/parallel_for.h"

namespace winslow {

namespace {

/// See BlockKernel.
template <int B>
void add_triple_products(const Real* left, const double* a, const Real* right, const Index* columns,
                         Index count, const Index* slot_of, double* coarse) {
  double product[B * B]{};  // left^T a
  for (int r = 0; r < B; ++r) {
    for (int k = 0; k < B; ++k) {
      for (int c = 0; c < B; ++c)
        product[r * B + c] += static_cast<double>(left[k * B + r]) * a[k * B + c];
    }
  }
  for (Index q = 0; q < count; ++q, right += B * B) {
    double* to = coarse + at(slot_of[columns[q]]) * B * B;
    for (int r = 0; r < B; ++r) {
      for (int k = 0; k < B; ++k) {
        for (int c = 0; c < B; ++c)
          to[r * B + c] += product[r * B + k] * static_cast<double>(right[k * B + c]);
      }
    }
  }
}

}  // namespace

void Prolongation::galerkin(const SparseMatrix& matrix, SparseMatrix& coarse, int threads) const {
  if (!coarse.pattern) coarse.pattern = galerkin_pattern(*matrix.pattern, threads);
  coarse.block = block_;
  coarse.symmetric = true;
  coarse.values.resize(coarse.pattern->columns.size() * at(block_ * block_));
  with_block(block_, [&](auto size) {
    parallel_for(threads, coarse_rows(), [&](Index begin, Index end) {
      galerkin_rows<size()>(matrix, coarse, begin, end);
    });
  });
}

/// Row a of the product is reached from the rows i of P^T, through the entries (i, j) of the matrix
/// and the rows j of P.
std::shared_ptr<const SparsityPattern> Prolongation::galerkin_pattern(const SparsityPattern& fine,
                                                                      int threads) const {
  const Index n = coarse_rows();
  const auto runs = at((n + parallel_block - 1) / parallel_block);
  std::vector<std::vector<Index>> columns(runs), counts(runs);
  parallel_for(threads, n, [&](Index begin, Index end) {
    std::vector<Index> seen(at(n), -1), row;
    for (Index a = begin; a < end; ++a) {
      row.clear();
      for (auto t = at(transposed_offsets_[at(a)]); t < at(transposed_offsets_[at(a) + 1]); ++t) {
        const auto i = at(transposed_rows_[t]);
        for (auto e = at(fine.offsets[i]); e < at(fine.offsets[i + 1]); ++e) {
          const auto j = at(fine.columns[e]);
          for (auto k = at(offsets_[j]); k < at(offsets_[j + 1]); ++k) {
            if (seen[at(columns_[k])] == a) continue;
            seen[at(columns_[k])] = a;
            row.push_back(columns_[k]);
          }
        }
      }
      std::sort(row.begin(), row.end());
      const auto run = at(begin / parallel_block);
      columns[run].insert(columns[run].end(), row.begin(), row.end());
      counts[run].push_back(static_cast<Index>(row.size()));
    }
  });
  auto built = std::make_shared<SparsityPattern>();
  for (std::size_t run = 0; run < runs; ++run) {
    built->columns.insert(built->columns.end(), columns[run].begin(), columns[run].end());
    for (const Index count : counts[run]) built->offsets.push_back(built->offsets.back() + count);
  }
  for (Index a = 0; a < n; ++a) {
    const auto first = built->columns.begin() + built->offsets[at(a)];
    const auto last = built->columns.begin() + built->offsets[at(a) + 1];
    built->diagonal.push_back(
        static_cast<Index>(std::lower_bound(first, last, a) - built->columns.begin()));
  }
  return built;
}

template <int B>
void Prolongation::galerkin_rows(const SparseMatrix& matrix, SparseMatrix& coarse, Index begin,
                                 Index end) const {
  const SparsityPattern& fine = *matrix.pattern;
  const SparsityPattern& p = *coarse.pattern;
  const auto add = B == 3 ? block_kernel().add_triple_products : add_triple_products<B>;
  constexpr std::size_t row_stride = B == 3 ? 4 : B, stride = B == 3 ? padded_block : B * B;
  std::vector<Index> slot_of(at(coarse_rows()));
  std::vector<double> sums;  // of one row
  for (auto a = at(begin); a < at(end); ++a) {
    const auto row = at(p.offsets[a]), size = at(p.offsets[a + 1]) - row;
    for (std::size_t s = 0; s < size; ++s) slot_of[at(p.columns[row + s])] = static_cast<Index>(s);
    sums.assign(stride * size, 0.0);
    for (auto t = at(transposed_offsets_[a]); t < at(transposed_offsets_[a + 1]); ++t) {
      const auto i = at(transposed_rows_[t]);
      const Real* left = &values_[at(transposed_entries_[t]) * B * B];
      for (auto e = at(fine.offsets[i]); e < at(fine.offsets[i + 1]); ++e) {
        const auto j = at(fine.columns[e]);
        const auto first = at(offsets_[j]);
        add(left, &matrix.values[e * B * B], &values_[first * B * B], &columns_[first],
            offsets_[j + 1] - offsets_[j], slot_of.data(), sums.data());
      }
    }
    double* to = &coarse.values[row * B * B];
    for (std::size_t s = 0; s < size; ++s) {
      for (std::size_t r = 0; r < B; ++r, to += B)
        std::copy_n(&sums[s * stride + r * row_stride], B, to);
    }
  }
}

}  // namespace winslow
