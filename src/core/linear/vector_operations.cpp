#include "core/linear/vector_operations.h"

#include <vector>

#include "core/linear/blocks.h"
#include "core/linear/worthwhile.h"
#include "core/parallel/parallel_for.h"

namespace winslow {

namespace {

/// Sum over [0, n) of what body(begin, end) returns for each block of it.
template <typename Body>
double blocked_sum(int threads, std::size_t numbers, Index n, Body&& body) {
  if (n <= parallel_block) return body(Index{0}, n);
  std::vector<double> sums(at((n + parallel_block - 1) / parallel_block), 0.0);
  parallel_for(worthwhile(threads, numbers), n, [&](Index begin, Index end) {
    sums[at(begin / parallel_block)] = body(begin, end);
  });
  double sum = 0;
  for (const double s : sums) sum += s;
  return sum;
}

/// out = start + sign A x over the rows [begin, end) of blocks. Returns the sum of weigh(out, i).
template <int B, typename Start, typename Add, typename Weigh>
double rows_product(const SparseMatrix& a, std::span<const double> x, Index begin, Index end,
                    std::span<double> out, Start&& start, Add&& add, Weigh&& weigh) {
  const SparsityPattern& p = *a.pattern;
  double sum = 0;
  for (auto i = at(begin); i < at(end); ++i) {
    double y[B];
    for (std::size_t r = 0; r < B; ++r) y[r] = start(i * B + r);
    for (auto e = at(p.offsets[i]); e < at(p.offsets[i + 1]); ++e) {
      add(&a.values[e * B * B], &x[at(p.columns[e]) * B], y);
    }
    for (std::size_t r = 0; r < B; ++r) {
      out[i * B + r] = y[r];
      sum += weigh(y[r], i * B + r);
    }
  }
  return sum;
}

Index length(std::span<const double> x) { return static_cast<Index>(x.size()); }

}  // namespace

double dot(std::span<const double> a, std::span<const double> b, int threads) {
  return blocked_sum(threads, 2 * a.size(), length(a), [&](Index begin, Index end) {
    double sum = 0;
    for (auto i = at(begin); i < at(end); ++i) sum += a[i] * b[i];
    return sum;
  });
}

void add_scaled(double factor, std::span<const double> x, std::span<double> y, int threads) {
  parallel_for(worthwhile(threads, 2 * x.size()), length(x), [&](Index begin, Index end) {
    for (auto i = at(begin); i < at(end); ++i) y[i] += factor * x[i];
  });
}

void scale_and_add(double factor, std::span<const double> x, std::span<double> y, int threads) {
  parallel_for(worthwhile(threads, 2 * x.size()), length(x), [&](Index begin, Index end) {
    for (auto i = at(begin); i < at(end); ++i) y[i] = x[i] + factor * y[i];
  });
}

double advance(double step, std::span<const double> p, std::span<const double> q,
               std::span<double> x, std::span<double> r, int threads) {
  return blocked_sum(threads, 4 * x.size(), length(x), [&](Index begin, Index end) {
    double sum = 0;
    for (auto i = at(begin); i < at(end); ++i) {
      x[i] += step * p[i];
      r[i] -= step * q[i];
      sum += r[i] * r[i];
    }
    return sum;
  });
}

double multiply(const SparseMatrix& a, std::span<const double> x, std::span<double> y,
                int threads) {
  return with_block(a.block, [&](auto size) {
    constexpr int B = size();
    return blocked_sum(threads, a.values.size(), a.pattern->rows(), [&](Index begin, Index end) {
      return rows_product<B>(
          a, x, begin, end, y, [](std::size_t) { return 0.0; },
          multiply_add<B, double, double, double>,
          [&](double value, std::size_t i) { return value * x[i]; });
    });
  });
}

double defect(const SparseMatrix& a, std::span<const double> b, std::span<const double> x,
              std::span<double> r, int threads) {
  return with_block(a.block, [&](auto size) {
    constexpr int B = size();
    return blocked_sum(threads, a.values.size(), a.pattern->rows(), [&](Index begin, Index end) {
      return rows_product<B>(
          a, x, begin, end, r, [&](std::size_t i) { return b[i]; },
          multiply_subtract<B, double, double, double>,
          [](double value, std::size_t) { return value * value; });
    });
  });
}

}  // namespace winslow
