#include "core/linear/vector_operations.h"

#include <cmath>
#include <limits>

#include "core/linear/blocks.h"
#include "core/parallel/parallel_for.h"

namespace winslow {

namespace {

/// Sum over [0, n) of what body(begin, end) returns for each block of it.
template <typename Body>
double blocked_sum(int threads, std::size_t numbers, Index n, Body&& body) {
  if (n <= parallel_block) return body(Index{0}, n);
  std::vector<double> sums(block_count(n), 0.0);
  parallel_for(worthwhile(threads, numbers), n, [&](Index begin, Index end) {
    sums[at(begin / parallel_block)] = body(begin, end);
  });
  double sum = 0;
  for (const double s : sums) sum += s;
  return sum;
}

/// out_i = value((A x)_i, i) over the rows [begin, end) of blocks. Returns the sum of
/// weigh(out_i, i).
template <int B, typename Value, typename Weigh>
double rows_product(const SparseMatrix& a, std::span<const double> x, Index begin, Index end,
                    std::span<double> out, Value&& value, Weigh&& weigh) {
  const SparsityPattern& p = *a.pattern;
  double sum = 0;
  for (auto i = at(begin); i < at(end); ++i) {
    double product[B];
    row_product<B>(a.values.data(), p.columns.data(), p.offsets[i], p.offsets[i + 1], x.data(),
                   product);
    for (std::size_t r = 0; r < B; ++r) {
      const double y = value(product[r], i * B + r);
      out[i * B + r] = y;
      sum += weigh(y, i * B + r);
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
          a, x, begin, end, y, [](double product, std::size_t) { return product; },
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
          a, x, begin, end, r, [&](double product, std::size_t i) { return b[i] - product; },
          [](double value, std::size_t) { return value * value; });
    });
  });
}

double relative_residual(const SparseMatrix& matrix, std::span<const double> rhs, int columns,
                         std::span<const double> x, int threads) {
  std::vector<double> solution(x.begin(), x.end()), r(static_cast<std::size_t>(matrix.rows()));
  double worst = 0;
  bool finite = true;
  for_each_column(rhs, columns, solution, [&](std::span<const double> b, std::span<double> y) {
    const double defect2 = defect(matrix, b, y, r, threads);
    const double rhs2 = dot(b, b, threads);
    const double relative = std::sqrt(rhs2 > 0 ? defect2 / rhs2 : defect2);
    // A solution that is not finite must not count as exact.
    finite = finite && std::isfinite(relative);
    worst = std::max(worst, relative);
  });
  return finite ? worst : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace winslow
