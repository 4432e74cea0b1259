#include "core/formulation/pointwise_winslow.h"

#include <algorithm>
#include <cmath>

#include "core/formulation/block_norms.h"
#include "core/parallel/parallel_for.h"

namespace winslow {

namespace {

using Matrix2 = Eigen::Matrix2d;

}  // namespace

PointwiseWinslow::PointwiseWinslow(const VirtualControlVolumes& vcv,
                                   std::shared_ptr<const NodeClasses> classes, int threads,
                                   bool clipped)
    : NodeProblem(NodeUnknowns(std::move(classes), threads)),
      functionals_(std::make_shared<const StencilFunctionals>(vcv)),
      pattern_(std::make_shared<const NodePattern>(topology(), node_unknowns().nodes())),
      clip_(clipped) {
  node_unknowns().require_free_interior("the pointwise form");
}

PointwiseWinslow PointwiseWinslow::clipped(bool clip) const {
  PointwiseWinslow other = *this;
  other.clip_ = clip;
  return other;
}

PointwiseWinslow PointwiseWinslow::with_vcvs(const VirtualControlVolumes& vcv) const {
  PointwiseWinslow other = *this;
  other.functionals_ = std::make_shared<const StencilFunctionals>(vcv);
  return other;
}

ClipVariants<PointwiseWinslow> clip_variants(const PointwiseWinslow& problem) {
  return {std::make_shared<const PointwiseWinslow>(problem.clipped(false)),
          std::make_shared<const PointwiseWinslow>(problem.clipped(true))};
}

WinslowCoefficients PointwiseWinslow::coefficients(const Coordinates& x, Index node) const {
  return winslow_coefficients(
      nodal_gradient(x, node, topology().neighbours(node), (*functionals_)[node]));
}

Index PointwiseWinslow::weights(const Coordinates& x, Index node, std::span<double> out) const {
  return evaluate_weights(x, node, clip_, out);
}

Index PointwiseWinslow::evaluate_weights(const Coordinates& x, Index node, bool clip,
                                         std::span<double> out) const {
  const WinslowCoefficients c = coefficients(x, node);
  const auto functionals = (*functionals_)[node];
  Index negative = 0;
  for (std::size_t k = 0; k < functionals.size(); ++k) {
    out[k] = winslow_weight(c, functionals[k]);
    if (out[k] < 0) {
      ++negative;
      if (clip) out[k] = 0;
    }
  }
  return negative;
}

ResidualNorms PointwiseWinslow::residual(const Coordinates& x, std::span<double> out) const {
  const Topology& topology = this->topology();
  const auto free = node_unknowns().nodes();
  const auto n = static_cast<Index>(free.size());
  BlockNorms norms(n);
  parallel_for(threads(), n, [&](Index begin, Index end) {
    std::vector<double> w;
    for (Index i = begin; i < end; ++i) {
      const Index node = free[at(i)];
      const auto neighbours = topology.neighbours(node);
      w.resize(neighbours.size());
      weights(x, node, w);
      const NodalRow row = evaluate_row(x, node, neighbours, w);
      norms.add(begin, row.scaled());
      if (!out.empty()) {
        out[2 * at(i)] = row.residual.x();
        out[2 * at(i) + 1] = row.residual.y();
      }
    }
  });
  return norms.total();
}

Index PointwiseWinslow::freeze(const Coordinates& x, SparseSystem& out) const {
  const Topology& topology = this->topology();
  const auto free = node_unknowns().nodes();
  const auto n = static_cast<Index>(free.size());
  SparseMatrix& matrix = out.matrix;
  matrix.pattern = pattern_->pattern;
  matrix.block = 1;
  matrix.symmetric = false;
  matrix.values.resize(matrix.pattern->columns.size());
  out.columns = 2;
  out.rhs.resize(2 * free.size());
  std::vector<Index> negative(at((n + parallel_block - 1) / parallel_block), 0);
  parallel_for(threads(), n, [&](Index begin, Index end) {
    std::vector<double> w;
    for (Index i = begin; i < end; ++i) {
      const Index node = free[at(i)];
      const auto neighbours = topology.neighbours(node);
      w.resize(neighbours.size());
      negative[at(begin / parallel_block)] += weights(x, node, w);
      const NodalRow row = evaluate_row(x, node, neighbours, w);
      const double scale = row.scale();
      matrix.values[at(matrix.pattern->diagonal[at(i)])] =
          row.absolute_sum > 0 ? row.weight_sum * scale : 1;
      const auto first = at(topology.neighbour_rows().offsets[at(node)]);
      for (std::size_t k = 0; k < neighbours.size(); ++k) {
        const Index entry = pattern_->entry_of_neighbour[first + k];
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

/// Derivative of one row, times its scale, by the position of each neighbour. With primes for
/// unnormalised coefficients and m = (alpha' + gamma') / 2,
///
///   dR = sum_k w_k (dr_k - dr_0) + (dalpha' Lxx - dbeta' Lxy + dgamma' Lyy - R dm) / m,
///
/// where Lxx, Lxy, Lyy are the flux functionals applied to r over the edges that are not clipped,
/// and every change of a coefficient is a change of r_x = sum_k dx_k (r_k - r_0) or of r_y.
class PointwiseWinslow::RowDerivative {
 public:
  /// weights: memory to work in, which belongs to this until it is gone.
  RowDerivative(const PointwiseWinslow& form, const Coordinates& x, Index node,
                std::vector<double>& weights)
      : functionals_((*form.functionals_)[node]), weights_(weights) {
    const auto neighbours = form.topology().neighbours(node);
    weights_.resize(neighbours.size());
    form.evaluate_weights(x, node, false, weights_);
    const Vec2 r0 = x.xy(node);
    Vec2 rx(0, 0), ry(0, 0), lxx(0, 0), lxy(0, 0), lyy(0, 0);
    for (std::size_t k = 0; k < weights_.size(); ++k) {
      const NeighbourFunctionals& f = functionals_[k];
      const Vec2 d = x.xy(neighbours[k]) - r0;
      rx += f.dx * d;
      ry += f.dy * d;
      if (form.clip_ && weights_[k] < 0) {
        weights_[k] = 0;
        continue;
      }
      lxx += f.lxx * d;
      lxy += f.lxy * d;
      lyy += f.lyy * d;
    }
    row_ = evaluate_row(x, node, neighbours, weights_);
    scale_ = row_.scale();
    const double mean = 0.5 * (rx.squaredNorm() + ry.squaredNorm());
    if (!(mean > 0)) return;  // the coefficients are constants there
    const Vec2& r = row_.residual;
    by_rx_ = ((2 * lyy - r) * rx.transpose() - lxy * ry.transpose()) / mean;
    by_ry_ = ((2 * lxx - r) * ry.transpose() - lxy * rx.transpose()) / mean;
  }

  const NodalRow& row() const { return row_; }
  Vec2 residual() const { return scale_ * row_.residual; }
  Matrix2 by_neighbour(std::size_t k) const {
    const Matrix2 of_weights = functionals_[k].dx * by_rx_ + functionals_[k].dy * by_ry_;
    return scale_ * (weights_[k] * Matrix2::Identity() + of_weights);
  }

 private:
  std::span<const NeighbourFunctionals> functionals_;
  std::vector<double>& weights_;
  NodalRow row_;
  double scale_ = 1;
  Matrix2 by_rx_ = Matrix2::Zero(), by_ry_ = Matrix2::Zero();
};

ResidualNorms PointwiseWinslow::linearise(const Coordinates& x, SparseMatrix& jacobian,
                                          std::span<double> residual) const {
  const Topology& topology = this->topology();
  const auto free = node_unknowns().nodes();
  const auto n = static_cast<Index>(free.size());
  jacobian.pattern = pattern_->pattern;
  jacobian.block = 2;
  jacobian.symmetric = false;
  jacobian.values.resize(4 * jacobian.pattern->columns.size());
  BlockNorms norms(n);
  const auto set = [&](Index entry, const Matrix2& block) {
    double* v = jacobian.values.data() + 4 * at(entry);
    v[0] = block(0, 0);
    v[1] = block(0, 1);
    v[2] = block(1, 0);
    v[3] = block(1, 1);
  };
  parallel_for(threads(), n, [&](Index begin, Index end) {
    std::vector<double> w;
    for (Index i = begin; i < end; ++i) {
      const Index node = free[at(i)];
      const RowDerivative derivative(*this, x, node, w);
      const auto first = at(topology.neighbour_rows().offsets[at(node)]);
      const std::size_t count = topology.neighbours(node).size();
      Matrix2 diagonal = Matrix2::Zero();
      for (std::size_t k = 0; k < count; ++k) {
        const Matrix2 block = derivative.by_neighbour(k);
        diagonal += block;
        const Index entry = pattern_->entry_of_neighbour[first + k];
        if (entry >= 0) set(entry, -block);
      }
      const bool empty = !(derivative.row().absolute_sum > 0);
      set(jacobian.pattern->diagonal[at(i)], empty ? Matrix2(Matrix2::Identity()) : diagonal);
      norms.add(begin, derivative.row().scaled());
      residual[2 * at(i)] = derivative.residual().x();
      residual[2 * at(i) + 1] = derivative.residual().y();
    }
  });
  return norms.total();
}

void PointwiseWinslow::boundary_response(const Coordinates& x, const Coordinates& displacement,
                                         std::span<double> out) const {
  const Topology& topology = this->topology();
  const auto free = node_unknowns().nodes();
  parallel_for(threads(), static_cast<Index>(free.size()), [&](Index begin, Index end) {
    std::vector<double> w;
    for (Index i = begin; i < end; ++i) {
      const Index node = free[at(i)];
      const auto neighbours = topology.neighbours(node);
      Vec2 change(0, 0);
      if (std::any_of(neighbours.begin(), neighbours.end(),
                      [&](Index k) { return pattern_->row_of_node[at(k)] < 0; })) {
        const RowDerivative derivative(*this, x, node, w);
        for (std::size_t k = 0; k < neighbours.size(); ++k) {
          if (pattern_->row_of_node[at(neighbours[k])] >= 0) continue;
          change += derivative.by_neighbour(k) * displacement.xy(neighbours[k]);
        }
      }
      out[2 * at(i)] = change.x();
      out[2 * at(i) + 1] = change.y();
    }
  });
}

void PointwiseWinslow::row_scales(const Coordinates& x, std::span<double> out) const {
  const Topology& topology = this->topology();
  const auto free = node_unknowns().nodes();
  parallel_for(threads(), static_cast<Index>(free.size()), [&](Index begin, Index end) {
    std::vector<double> w;
    for (Index i = begin; i < end; ++i) {
      const auto neighbours = topology.neighbours(free[at(i)]);
      w.resize(neighbours.size());
      weights(x, free[at(i)], w);
      out[at(i)] = evaluate_row(x, free[at(i)], neighbours, w).scale();
    }
  });
}

std::vector<double> PointwiseWinslow::merit_weights(const Coordinates& x) const {
  const auto free = node_unknowns().nodes();
  std::vector<double> weights(free.size());
  row_scales(x, weights);
  for (std::size_t i = 0; i < free.size(); ++i) {
    const double edge = node_unknowns().mean_edge(x, free[i]);
    if (edge > 0) weights[i] /= edge;
  }
  return weights;
}

double PointwiseWinslow::merit(const Coordinates& x, std::span<const double> weights) const {
  std::vector<double> rows(unknowns());
  residual(x, rows);
  double sum = 0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    const Vec2 r(rows[2 * i], rows[2 * i + 1]);
    sum += weights[i] * weights[i] * r.squaredNorm();
  }
  return sum;
}

}  // namespace winslow
