#include "core/formulation/pointwise_winslow.h"

#include <algorithm>
#include <cmath>

#include "core/parallel/parallel_for.h"

namespace winslow {

namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

/// Maximum that a NaN does not get lost in, whichever side it is on.
double larger(double a, double b) { return std::isnan(a) || a >= b ? a : b; }

/// What one row of the operator amounts to.
struct Row {
  Vec2 residual{0, 0};
  double weight_sum = 0;
  double absolute_sum = 0;
  double mean_edge = 0;

  /// Distance by which the node alone would move, its neighbours held, over the mean edge.
  double scaled() const {
    const double scale = absolute_sum * mean_edge;
    return scale > 0 ? residual.norm() / scale : residual.norm();
  }
};

Row evaluate_row(const Coordinates& x, Index node, std::span<const Index> neighbours,
                 std::span<const double> weights) {
  Row row;
  const Vec2 r0 = x.xy(node);
  for (std::size_t k = 0; k < neighbours.size(); ++k) {
    const Vec2 d = x.xy(neighbours[k]) - r0;
    row.residual += weights[k] * d;
    row.weight_sum += weights[k];
    row.absolute_sum += std::abs(weights[k]);
    row.mean_edge += d.norm();
  }
  row.mean_edge /= static_cast<double>(neighbours.size());
  return row;
}

}  // namespace

PointwiseWinslow::PointwiseWinslow(const VirtualControlVolumes& vcv, int threads)
    : topology_(vcv.shared_topology()),
      functionals_(vcv),
      pattern_(*topology_),
      threads_(threads) {}

WinslowCoefficients PointwiseWinslow::coefficients(const Coordinates& x, Index node) const {
  const auto neighbours = topology_->neighbours(node);
  const auto functionals = functionals_[node];
  const Vec2 r0 = x.xy(node);
  Vec2 rx(0, 0), ry(0, 0);
  for (std::size_t k = 0; k < neighbours.size(); ++k) {
    const Vec2 d = x.xy(neighbours[k]) - r0;
    rx += functionals[k].dx * d;
    ry += functionals[k].dy * d;
  }
  const double alpha = ry.squaredNorm();
  const double gamma = rx.squaredNorm();
  const double mean = 0.5 * (alpha + gamma);
  if (!(mean > 0)) return {};
  return {alpha / mean, rx.dot(ry) / mean, gamma / mean};
}

Index PointwiseWinslow::weights(const Coordinates& x, Index node, bool clip,
                                std::span<double> out) const {
  const WinslowCoefficients c = coefficients(x, node);
  const auto functionals = functionals_[node];
  Index negative = 0;
  for (std::size_t k = 0; k < functionals.size(); ++k) {
    const auto& f = functionals[k];
    out[k] = c.alpha * f.lxx - c.beta * f.lxy + c.gamma * f.lyy;
    if (out[k] < 0) {
      ++negative;
      if (clip) out[k] = 0;
    }
  }
  return negative;
}

ResidualNorms PointwiseWinslow::residual(const Coordinates& x, bool clip,
                                         std::span<double> out) const {
  const auto free = topology_->free_nodes();
  const auto n = static_cast<Index>(free.size());
  const auto blocks = at((n + parallel_block - 1) / parallel_block);
  std::vector<double> block_max(blocks, 0.0), block_sum(blocks, 0.0);
  parallel_for(threads_, n, [&](Index begin, Index end) {
    std::vector<double> w;
    const auto block = at(begin / parallel_block);
    for (Index i = begin; i < end; ++i) {
      const Index node = free[at(i)];
      const auto neighbours = topology_->neighbours(node);
      w.resize(neighbours.size());
      weights(x, node, clip, w);
      const Row row = evaluate_row(x, node, neighbours, w);
      const double scaled = row.scaled();
      block_max[block] = larger(block_max[block], scaled);
      block_sum[block] += scaled * scaled;
      if (!out.empty()) {
        out[2 * at(i)] = row.residual.x();
        out[2 * at(i) + 1] = row.residual.y();
      }
    }
  });
  ResidualNorms norms;
  for (std::size_t b = 0; b < blocks; ++b) {
    norms.max = larger(norms.max, block_max[b]);
    norms.rms += block_sum[b];
  }
  norms.rms = n > 0 ? std::sqrt(norms.rms / n) : 0;
  return norms;
}

Index PointwiseWinslow::freeze(const Coordinates& x, bool clip, SparseSystem& out) const {
  const auto free = topology_->free_nodes();
  const auto n = static_cast<Index>(free.size());
  SparseMatrix& matrix = out.matrix;
  matrix.pattern = pattern_.pattern;
  matrix.block = 1;
  matrix.symmetric = false;
  matrix.values.resize(matrix.pattern->columns.size());
  out.columns = 2;
  out.rhs.resize(2 * free.size());
  std::vector<Index> negative(at((n + parallel_block - 1) / parallel_block), 0);
  parallel_for(threads_, n, [&](Index begin, Index end) {
    std::vector<double> w;
    for (Index i = begin; i < end; ++i) {
      const Index node = free[at(i)];
      const auto neighbours = topology_->neighbours(node);
      w.resize(neighbours.size());
      negative[at(begin / parallel_block)] += weights(x, node, clip, w);
      const Row row = evaluate_row(x, node, neighbours, w);
      // Rows are scaled to a diagonal near one: w carries the square of the local size otherwise.
      const double scale = row.absolute_sum > 0 ? 1 / row.absolute_sum : 1;
      matrix.values[at(matrix.pattern->diagonal[at(i)])] =
          row.absolute_sum > 0 ? row.weight_sum * scale : 1;
      const auto first = at(topology_->neighbour_rows().offsets[at(node)]);
      for (std::size_t k = 0; k < neighbours.size(); ++k) {
        const Index entry = pattern_.entry_of_neighbour[first + k];
        if (entry >= 0) matrix.values[at(entry)] = -w[k] * scale;
      }
      out.rhs[2 * at(i)] = row.residual.x() * scale;
      out.rhs[2 * at(i) + 1] = row.residual.y() * scale;
    }
  });
  Index total = 0;
  for (const Index count : negative) total += count;
  return total;
}

}  // namespace winslow
