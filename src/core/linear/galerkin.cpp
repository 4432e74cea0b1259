#include <algorithm>
#include <cstddef>
#include <utility>

#include "core/linear/block_kernel.h"
#include "core/linear/blocks.h"
#include "core/linear/pattern_builder.h"
#include "core/linear/prolongation.h"
#include "core/parallel/parallel_for.h"

namespace winslow {

namespace {

/// Rows of the coarse matrix at a time: there are few of them, and each takes long.
constexpr Index coarse_block = 256;

/// See BlockKernel.
template <int B>
void add_triple_products(const Real* left, const double* a, const Real* right, const Index* columns,
                         Index count, const Index* slot_of, double* coarse) {
  constexpr std::ptrdiff_t size = std::ptrdiff_t{B} * B;
  double product[B * B]{};  // left^T a
  for (int r = 0; r < B; ++r) {
    for (int k = 0; k < B; ++k) {
      for (int c = 0; c < B; ++c)
        product[r * B + c] += static_cast<double>(left[k * B + r]) * a[k * B + c];
    }
  }
  for (Index q = 0; q < count; ++q, right += size) {
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
    parallel_for(
        threads, coarse_rows(),
        [&](Index begin, Index end) { galerkin_rows<size()>(matrix, coarse, begin, end); },
        coarse_block);
  });
}

/// Row a of the product is reached from the rows i of P^T, through the entries (i, j) of the matrix
/// and the rows j of P.
std::shared_ptr<const SparsityPattern> Prolongation::galerkin_pattern(const SparsityPattern& fine,
                                                                      int threads) const {
  const auto begin_block = [&] {
    return [&, seen = std::vector<Index>(at(coarse_rows()), -1)](
               Index a, std::vector<Index>& columns) mutable {
      for (auto t = at(transposed_offsets_[at(a)]); t < at(transposed_offsets_[at(a) + 1]); ++t) {
        const auto i = at(transposed_rows_[t]);
        for (auto e = at(fine.offsets[i]); e < at(fine.offsets[i + 1]); ++e) {
          const auto j = at(fine.columns[e]);
          for (auto k = at(offsets_[j]); k < at(offsets_[j + 1]); ++k) {
            if (std::exchange(seen[at(columns_[k])], a) != a) columns.push_back(columns_[k]);
          }
        }
      }
    };
  };
  return build_pattern(coarse_rows(), coarse_block, threads, begin_block);
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
