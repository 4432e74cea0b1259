#include "core/formulation/variational_form.h"

#include "core/parallel/parallel_for.h"

namespace winslow {

namespace {

/// Mean |determinant| of the cells around each cell's nodes.
template <std::size_t N>
std::vector<double> sizes_around(const std::vector<std::array<Index, N>>& cells,
                                 std::span<const double> determinants, Index node_count) {
  std::vector<double> sum(at(node_count), 0.0);
  std::vector<int> count(sum.size(), 0);
  for (std::size_t t = 0; t < cells.size(); ++t) {
    for (const Index node : cells[t]) {
      sum[at(node)] += std::abs(determinants[t]);
      ++count[at(node)];
    }
  }
  std::vector<double> sizes;
  sizes.reserve(cells.size());
  for (const auto& nodes : cells) {
    double size = 0;
    for (const Index node : nodes) size += sum[at(node)] / count[at(node)];
    sizes.push_back(std::max(size / static_cast<double>(N), std::numeric_limits<double>::min()));
  }
  return sizes;
}

}  // namespace

template <int D>
std::shared_ptr<const VariationalForm> TargetForm<D>::with_penalty(
    const PenaltyOptions& penalty) const {
  auto other = copy();
  other->set_penalty(penalty);
  return other;
}

template <int D>
std::shared_ptr<const TargetForm<D>> TargetForm<D>::with_shapes(
    std::shared_ptr<const Targets> shapes) const {
  auto other = copy();
  other->shapes_ = std::move(shapes);
  return other;
}

template <int D>
std::vector<double> TargetForm<D>::cell_sizes(const Coordinates& x) const {
  return sizes_around(shapes_->cells, determinants(x, nullptr), this->topology().node_count());
}

template <int D>
Regularisation TargetForm<D>::regularisation(const Coordinates& x, std::span<const double> sizes,
                                             const Softness& softness) const {
  Regularisation out;
  const std::vector<double> seen = determinants(x, &out);
  out.size.reserve(seen.size());
  for (std::size_t t = 0; t < seen.size(); ++t)
    out.size.push_back(
        std::hypot(softness.of_size * sizes[t], softness.of_inverted * std::min(0.0, seen[t])));
  return out;
}

template <int D>
Regularisation TargetForm<D>::full_regularisation(const Coordinates& x) const {
  constexpr double far_beyond = 1e6;  // the largest determinant
  Regularisation out;
  double largest = std::numeric_limits<double>::min();
  for (const double seen : determinants(x, &out)) largest = std::max(largest, std::abs(seen));
  out.size.assign(shapes_->cells.size(), far_beyond * largest);
  return out;
}

template <int D>
distortion::SimplexData TargetForm<D>::data(const Targets& targets, const double* points,
                                            const Index* nodes,
                                            const Regularisation* regularisation) const {
  static_assert(sizeof(typename Targets::Term) ==
                distortion::SimplexLayout<D>::term * sizeof(double));
  distortion::SimplexData data;
  data.x = points;
  data.nodes = nodes;
  data.offsets = targets.offsets.data();
  // Points to the first member of the first term: terms consist only of numbers.
  data.terms = reinterpret_cast<const double*>(targets.terms.data());
  if (has_guards()) data.inverse_limits = targets.inverse_limits.data();
  data.penalty = psi().constants();
  if (regularisation) {
    data.size = regularisation->size.data();
    data.epsilon = 1;
    data.curvature_share = 0;
  }
  return data;
}

template <int D>
double TargetForm<D>::sum_energy(const distortion::SimplexData& cells) const {
  const auto n = static_cast<Index>(shapes_->cells.size());
  std::vector<double> sums(block_count(n), 0.0);
  parallel_for(this->threads(), n, [&](Index begin, Index end) {
    sums[at(begin / parallel_block)] = kernel_.energy(cells, begin, end);
  });
  return std::accumulate(sums.begin(), sums.end(), 0.0);
}

template <int D>
double TargetForm<D>::largest_of_cells(const std::function<double(std::size_t)>& of_cell) const {
  const auto n = static_cast<Index>(shapes_->cells.size());
  std::vector<double> largest(block_count(n), 0.0);
  parallel_for(this->threads(), n, [&](Index begin, Index end) {
    double& of_block = largest[at(begin / parallel_block)];
    for (Index t = begin; t < end; ++t) of_block = std::max(of_block, of_cell(at(t)));
  });
  return largest.empty() ? 0 : *std::ranges::max_element(largest);
}

template <int D>
Index TargetForm<D>::stuck_nodes() const {
  return static_cast<Index>(std::ranges::count(stuck_, true));
}

template <int D>
std::vector<bool> TargetForm<D>::stuck_rows() const {
  return stuck_.empty() ? std::vector<bool>(this->node_unknowns().nodes().size(), false) : stuck_;
}

template <int D>
std::shared_ptr<const EnergyProblem> TargetForm<D>::holding(std::vector<bool> stuck) const {
  if (std::ranges::count(stuck, true) == stuck_nodes()) return nullptr;
  auto other = copy();
  other->stuck_ = std::move(stuck);
  return other;
}

template class TargetForm<2>;
template class TargetForm<3>;

}  // namespace winslow
