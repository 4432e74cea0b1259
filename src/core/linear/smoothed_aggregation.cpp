#include "core/linear/smoothed_aggregation.h"

#include <cmath>
#include <numeric>

#include "core/linear/block_kernel.h"
#include "core/linear/pattern_builder.h"
#include "core/linear/vector_operations.h"
#include "core/parallel/parallel_for.h"

namespace winslow {

namespace {

/// Calls body(neighbour) for the rows that row i is strongly connected to.
template <typename Body>
void each_neighbour(const SparsityPattern& graph, std::span<const char> strong, Index i,
                    Body&& body) {
  for (auto e = at(graph.offsets[at(i)]); e < at(graph.offsets[at(i) + 1]); ++e) {
    if (graph.columns[e] != i && (strong.empty() || strong[e])) body(graph.columns[e]);
  }
}

/// Graph of the patches: two patches are connected if any of their rows are.
SparsityPattern patch_graph(const SparsityPattern& graph, const Aggregates& patches) {
  std::vector<Index> start(at(patches.count) + 1, 0), members(graph.diagonal.size());
  for (const Index p : patches.of_row) {
    if (p >= 0) ++start[at(p) + 1];
  }
  std::partial_sum(start.begin(), start.end(), start.begin());
  std::vector<Index> next(start.begin(), start.end() - 1);
  for (Index i = 0; i < graph.rows(); ++i) {
    const Index p = patches.of_row[at(i)];
    if (p >= 0) members[at(next[at(p)]++)] = i;
  }
  SparsityPattern result;
  std::vector<Index> seen(at(patches.count), -1), row;
  for (Index p = 0; p < patches.count; ++p) {
    row.assign(1, p);
    seen[at(p)] = p;
    for (Index m = start[at(p)]; m < start[at(p) + 1]; ++m) {
      each_neighbour(graph, {}, members[at(m)], [&](Index j) {
        const Index q = patches.of_row[at(j)];
        if (q < 0 || seen[at(q)] == p) return;
        seen[at(q)] = p;
        row.push_back(q);
      });
    }
    result.columns.insert(result.columns.end(), row.begin(), row.end());
    result.diagonal.push_back(result.offsets.back());
    result.offsets.push_back(static_cast<Index>(result.columns.size()));
  }
  return result;
}

/// Sorts rows by the position of their patch, which keeps patches together.
std::vector<Index> sorted_by_patch(const Aggregates& patches,
                                   const std::vector<Index>& patch_order) {
  std::vector<Index> start(at(patches.count) + 2, 0), place(at(patches.count));
  for (std::size_t k = 0; k < patch_order.size(); ++k) {
    place[at(patch_order[k])] = static_cast<Index>(k);
  }
  // Rows of no patch come last.
  const auto place_of = [&](Index patch) { return patch >= 0 ? place[at(patch)] : patches.count; };
  for (const Index p : patches.of_row) ++start[at(place_of(p)) + 1];
  std::partial_sum(start.begin(), start.end(), start.begin());
  std::vector<Index> order(patches.of_row.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    order[at(start[at(place_of(patches.of_row[i]))]++)] = static_cast<Index>(i);
  }
  return order;
}

}  // namespace

Aggregates aggregate(const SparsityPattern& graph, std::span<const char> strong) {
  const Index n = graph.rows();
  Aggregates result;
  std::vector<Index>& of = result.of_row;
  of.assign(at(n), -1);
  // First round: whole neighbourhoods of unassigned rows.
  for (Index i = 0; i < n; ++i) {
    bool free = of[at(i)] < 0, connected = false;
    each_neighbour(graph, strong, i, [&](Index j) {
      connected = true;
      free = free && of[at(j)] < 0;
    });
    if (!free || !connected) continue;
    of[at(i)] = result.count;
    each_neighbour(graph, strong, i, [&](Index j) { of[at(j)] = result.count; });
    ++result.count;
  }
  // Remaining rows join the smallest adjacent patch of the first round, for even sizes.
  const std::vector<Index> first = of;
  std::vector<Index> size(at(result.count), 0);
  for (const Index a : of) {
    if (a >= 0) ++size[at(a)];
  }
  for (Index i = 0; i < n; ++i) {
    if (of[at(i)] >= 0) continue;
    Index best = -1;
    each_neighbour(graph, strong, i, [&](Index j) {
      const Index a = first[at(j)];
      if (a >= 0 && (best < 0 || size[at(a)] < size[at(best)])) best = a;
    });
    of[at(i)] = best;
    if (best >= 0) ++size[at(best)];
  }
  // With one-way connections some rows have no such neighbour: these form their own patches.
  for (Index i = 0; i < n; ++i) {
    if (of[at(i)] >= 0) continue;
    bool connected = false;
    each_neighbour(graph, strong, i, [&](Index j) {
      connected = true;
      if (of[at(j)] < 0) of[at(j)] = result.count;
    });
    if (connected) of[at(i)] = result.count++;
  }
  return result;
}

std::vector<Index> locality_ordering(const SparsityPattern& graph) {
  const Aggregates patches = aggregate(graph);
  std::vector<Index> patch_order(at(patches.count));
  std::iota(patch_order.begin(), patch_order.end(), 0);
  if (patches.count > 1) patch_order = locality_ordering(patch_graph(graph, patches));
  return sorted_by_patch(patches, patch_order);
}

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
    values_.resize(columns_.size() * at(size() * size()) + block_tail);
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
    // Lumping can make the diagonal too small; then it is omitted for this row.
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
                           int threads, int width) const {
  with_shape(block_, width, [&](auto size, auto count) {
    constexpr int B = size(), N = count();
    parallel_for(worthwhile(threads, values_.size()), rows_, [&](Index begin, Index end) {
      for (auto i = at(begin); i < at(end); ++i) {
        const Row<N> sum =
            load_row<N>(&x[i * N]) + interpolated<B, N>(offsets_[i], offsets_[i + 1], coarse);
        store_row<N>(sum, &x[i * N]);
        store_row<N>(sum, &copy[i * N]);
      }
    });
  });
}

/// A row of P, its entries [first, last), times coarse numbers.
template <int B, int N>
Row<N> Prolongation::interpolated(Index first, Index last, std::span<const Real> coarse) const {
  Row<N> sums[B]{};  // B > 1: of the products of a row of the block, number by number
  for (auto e = at(first); e < at(last); ++e) {
    const Row<N> from = load_row<N>(&coarse[at(columns_[e]) * N]);
    const Real* p = &values_[e * B * B];
    for (std::size_t r = 0; r < B; ++r) {
      if constexpr (B == 1)
        sums[r] += p[0] * from;
      else
        sums[r] += load_row<N>(p + r * B) * from;
    }
  }
  if constexpr (B == 1) return sums[0];
  Row<N> out{};
  for (int r = 0; r < B; ++r) {
    out[r] = sums[r][0];
    for (int c = 1; c < B; ++c) out[r] += sums[r][c];
  }
  return out;
}

void Prolongation::restrict(std::span<const Real> r, std::span<Real> coarse, int threads,
                            int width) const {
  with_shape(block_, width, [&](auto size, auto count) {
    constexpr std::size_t B = size(), N = count();
    constexpr Index coarse_block = 256;  // few rows, each expensive
    parallel_for(
        worthwhile(threads, values_.size()), coarse_rows(),
        [&](Index begin, Index end) {
          for (auto a = at(begin); a < at(end); ++a) {
            // The rows of a block are the columns of its transpose.
            BlockSum<size(), count()> sum;
            for (auto t = at(transposed_offsets_[a]); t < at(transposed_offsets_[a + 1]); ++t)
              sum.add(&values_[at(transposed_entries_[t]) * B * B],
                      &r[at(transposed_rows_[t]) * N]);
            store_row<N>(sum.total(), &coarse[a * N]);
          }
        },
        coarse_block);
  });
}

namespace {

/// Rows of the coarse matrix per block: there are few rows, and each is expensive.
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
