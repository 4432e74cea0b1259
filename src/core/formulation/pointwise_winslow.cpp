#include "core/formulation/pointwise_winslow.h"

#include "core/formulation/row_elimination.h"
#include "core/parallel/parallel_for.h"

namespace winslow {

PointwisePattern::PointwisePattern(std::shared_ptr<const NodeClasses> classes, int threads)
    : nodes(std::move(classes), threads),
      rows(std::make_shared<const NodePattern>(nodes.topology(), nodes.nodes())) {
  nodes.require_free_interior("the pointwise form");
}

template <int D>
PointwiseForm<D>::PointwiseForm(const Vcvs& vcvs, const PointwisePattern& pattern, bool clipped)
    : NodeProblem(pattern.nodes),
      functionals_(std::make_shared<const typename Operator::Functionals>(
          Operator::functionals(vcvs, threads()))),
      pattern_(pattern.rows),
      clip_(clipped) {}

template <int D>
PointwiseForm<D> PointwiseForm<D>::clipped(bool clip) const {
  PointwiseForm other = *this;
  other.clip_ = clip;
  return other;
}

template <int D>
auto PointwiseForm<D>::gradient(const Coordinates& x, Index node) const -> Matrix {
  const auto functionals = (*functionals_)[node];
  const auto neighbours = topology().neighbours(node);
  Matrix g = Matrix::Zero();
  const Vec<D> r0 = x.get<D>(node);
  for (std::size_t k = 0; k < neighbours.size(); ++k) {
    const Vec<D> d = x.get<D>(neighbours[k]) - r0;
    const Vec<D> share = Operator::gradient(functionals[k]);
    for (int c = 0; c < D; ++c) g.col(c) += share[c] * d;
  }
  return g;
}

template <int D>
auto PointwiseForm<D>::coefficients(const Coordinates& x, Index node) const ->
    typename Operator::Coefficients {
  return Operator::coefficients(gradient(x, node));
}

template <int D>
Index PointwiseForm<D>::weights(const Coordinates& x, Index node, std::span<double> out) const {
  return evaluate_weights(x, node, clip_, out);
}

template <int D>
Index PointwiseForm<D>::evaluate_weights(const Coordinates& x, Index node, bool clip,
                                         std::span<double> out) const {
  const auto c = coefficients(x, node);
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

/// visit(i, first free node of i's block, memory for weights) for each free node, on several
/// threads.
template <int D>
template <typename Visit>
void PointwiseForm<D>::each_node(Visit&& visit) const {
  const auto count = static_cast<Index>(node_unknowns().nodes().size());
  parallel_for(threads(), count, [&](Index begin, Index end) {
    std::vector<double> w;
    for (Index i = begin; i < end; ++i) visit(i, begin, w);
  });
}

/// visit(i, first free node of i's block, neighbours of node i, their weights, number of negative
/// weights, the row) for each free node, on several threads.
template <int D>
template <typename Visit>
void PointwiseForm<D>::each_row(const Coordinates& x, Visit&& visit) const {
  const auto free = node_unknowns().nodes();
  each_node([&](Index i, Index block, std::vector<double>& w) {
    const auto neighbours = topology().neighbours(free[at(i)]);
    w.resize(neighbours.size());
    const Index negative = weights(x, free[at(i)], w);
    visit(i, block, neighbours, w, negative, evaluate_row<D>(x, free[at(i)], neighbours, w));
  });
}

template <int D>
ResidualNorms PointwiseForm<D>::residual(const Coordinates& x, std::span<double> out) const {
  std::vector<NormSum> norms(block_count(static_cast<Index>(node_unknowns().nodes().size())));
  each_row(x, [&](Index i, Index block, auto, const auto&, Index, const NodalRowOf<D>& row) {
    norms[at(block / parallel_block)].add(row.scaled());
    if (!out.empty()) std::copy_n(row.residual.data(), D, out.data() + D * at(i));
  });
  return NormSum::total(norms);
}

template <int D>
Index PointwiseForm<D>::freeze(const Coordinates& x, SparseSystem& out) const {
  const auto free = node_unknowns().nodes();
  SparseMatrix& matrix = out.matrix;
  matrix.pattern = pattern_->pattern;
  matrix.block = 1;
  matrix.symmetric = false;
  matrix.in_space = D == 3;
  matrix.values.resize(matrix.pattern->columns.size());
  out.columns = D;
  out.rhs.resize(D * free.size());
  std::vector<Index> negative(block_count(static_cast<Index>(free.size())), 0);
  each_row(x, [&](Index i, Index block, auto neighbours, const auto& w, Index count,
                  const NodalRowOf<D>& row) {
    negative[at(block / parallel_block)] += count;
    const double scale = row.scale();
    matrix.values[at(matrix.pattern->diagonal[at(i)])] =
        row.absolute_sum > 0 ? row.weight_sum * scale : 1;
    const auto first = at(topology().neighbour_rows().offsets[at(free[at(i)])]);
    for (std::size_t k = 0; k < neighbours.size(); ++k) {
      const Index entry = pattern_->entry_of_neighbour[first + k];
      if (entry >= 0) matrix.values[at(entry)] = -w[k] * scale;
    }
    for (std::size_t c = 0; c < D; ++c)
      out.rhs[D * at(i) + c] = row.residual[static_cast<Index>(c)] * scale;
  });
  return std::accumulate(negative.begin(), negative.end(), Index{0});
}

/// Derivative of one row, times its scale, with respect to the position of each neighbour; see
/// StencilOperator.
template <int D>
class PointwiseForm<D>::RowDerivative {
 public:
  /// weights: work memory, used by this object throughout its lifetime.
  RowDerivative(const PointwiseForm& form, const Coordinates& x, Index node,
                std::vector<double>& weights)
      : functionals_((*form.functionals_)[node]), weights_(weights) {
    const auto neighbours = form.topology().neighbours(node);
    weights_.resize(neighbours.size());
    form.evaluate_weights(x, node, false, weights_);
    const Vec<D> r0 = x.get<D>(node);
    typename Operator::Fluxes fluxes;
    fluxes.fill(Vec<D>::Zero());
    for (std::size_t k = 0; k < weights_.size(); ++k) {
      if (form.clip_ && weights_[k] < 0) {
        weights_[k] = 0;
        continue;
      }
      const Vec<D> d = x.get<D>(neighbours[k]) - r0;
      const auto flux = Operator::flux(functionals_[k]);
      for (std::size_t c = 0; c < flux.size(); ++c) fluxes[c] += flux[c] * d;
    }
    row_ = evaluate_row<D>(x, node, neighbours, weights_);
    scale_ = row_.scale();
    slopes_ = Operator::slopes(form.gradient(x, node), fluxes, row_.residual);
  }

  const NodalRowOf<D>& row() const { return row_; }
  Vec<D> residual() const { return scale_ * row_.residual; }
  Matrix by_neighbour(std::size_t k) const {
    const Vec<D> share = Operator::gradient(functionals_[k]);
    Matrix sum = weights_[k] * Matrix::Identity();
    for (int c = 0; c < D; ++c) sum += share[c] * slopes_[static_cast<std::size_t>(c)];
    return scale_ * sum;
  }

 private:
  std::span<const typename Operator::Functional> functionals_;
  std::vector<double>& weights_;
  NodalRowOf<D> row_;
  double scale_ = 1;
  std::array<Matrix, D> slopes_;
};

template <int D>
ResidualNorms PointwiseForm<D>::linearise(const Coordinates& x, SparseMatrix& jacobian,
                                          std::span<double> residual) const {
  const auto free = node_unknowns().nodes();
  jacobian.pattern = pattern_->pattern;
  jacobian.block = D;
  jacobian.symmetric = false;
  jacobian.in_space = D == 3;
  constexpr std::size_t block_size = std::size_t{D} * D;
  jacobian.values.resize(block_size * jacobian.pattern->columns.size());
  std::vector<NormSum> norms(block_count(static_cast<Index>(free.size())));
  const auto set = [&](Index entry, const Matrix& block) {
    double* v = jacobian.values.data() + block_size * at(entry);
    for (int r = 0; r < D; ++r) {
      for (int c = 0; c < D; ++c) *v++ = block(r, c);
    }
  };
  each_node([&](Index i, Index block, std::vector<double>& w) {
    const RowDerivative derivative(*this, x, free[at(i)], w);
    const auto first = at(topology().neighbour_rows().offsets[at(free[at(i)])]);
    Matrix diagonal = Matrix::Zero();
    for (std::size_t k = 0; k < w.size(); ++k) {
      const Matrix by = derivative.by_neighbour(k);
      diagonal += by;
      const Index entry = pattern_->entry_of_neighbour[first + k];
      if (entry >= 0) set(entry, -by);
    }
    const bool empty = !(derivative.row().absolute_sum > 0);
    set(jacobian.pattern->diagonal[at(i)], empty ? Matrix(Matrix::Identity()) : diagonal);
    norms[at(block / parallel_block)].add(derivative.row().scaled());
    const Vec<D> r = derivative.residual();
    std::copy_n(r.data(), D, residual.data() + D * at(i));
  });
  return NormSum::total(norms);
}

template <int D>
void PointwiseForm<D>::boundary_response(const Coordinates& x, const Coordinates& displacement,
                                         std::span<double> out) const {
  const auto free = node_unknowns().nodes();
  each_node([&](Index i, Index, std::vector<double>& w) {
    const auto neighbours = topology().neighbours(free[at(i)]);
    const auto held = [&](Index k) { return pattern_->row_of_node[at(k)] < 0; };
    Vec<D> change = Vec<D>::Zero();
    if (std::ranges::any_of(neighbours, held)) {
      const RowDerivative derivative(*this, x, free[at(i)], w);
      for (std::size_t k = 0; k < neighbours.size(); ++k) {
        if (held(neighbours[k]))
          change += derivative.by_neighbour(k) * displacement.get<D>(neighbours[k]);
      }
    }
    std::copy_n(change.data(), D, out.data() + D * at(i));
  });
}

template <int D>
void PointwiseForm<D>::row_scales(const Coordinates& x, std::span<double> out) const {
  each_row(x, [&](Index i, Index, auto, const auto&, Index, const NodalRowOf<D>& row) {
    out[at(i)] = row.scale();
  });
}

template <int D>
std::vector<double> PointwiseForm<D>::merit_weights(const Coordinates& x) const {
  const auto free = node_unknowns().nodes();
  std::vector<double> weights(free.size());
  row_scales(x, weights);
  for (std::size_t i = 0; i < free.size(); ++i) {
    const double edge = node_unknowns().mean_edge(x, free[i]);
    if (edge > 0) weights[i] /= edge;
  }
  return weights;
}

template <int D>
double PointwiseForm<D>::merit(const Coordinates& x, std::span<const double> weights) const {
  std::vector<double> rows(unknowns());
  residual(x, rows);
  double sum = 0;
  for (std::size_t i = 0; i < weights.size(); ++i)
    sum += weights[i] * weights[i] * Vec<D>(rows.data() + D * i).squaredNorm();
  return sum;
}

template class PointwiseForm<2>;
template class PointwiseForm<3>;

}  // namespace winslow
