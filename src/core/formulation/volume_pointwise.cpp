#include "core/formulation/volume_pointwise.h"

#include <algorithm>

#include "core/formulation/block_norms.h"
#include "core/parallel/parallel_for.h"

namespace winslow {

VolumePointwise::VolumePointwise(const VolumeVcvs& vcvs, std::shared_ptr<const NodeClasses> classes,
                                 int threads, bool clipped)
    : NodeProblem(NodeUnknowns(std::move(classes), threads)),
      functionals_(std::make_shared<const VolumeFunctionals>(vcvs, threads)),
      pattern_(std::make_shared<const NodePattern>(topology(), node_unknowns().nodes())),
      clip_(clipped) {
  node_unknowns().require_free_interior("the pointwise form");
}

VolumePointwise VolumePointwise::clipped(bool clip) const {
  VolumePointwise other = *this;
  other.clip_ = clip;
  return other;
}

VolumePointwise VolumePointwise::with_vcvs(const VolumeVcvs& vcvs) const {
  VolumePointwise other = *this;
  other.functionals_ = std::make_shared<const VolumeFunctionals>(vcvs, threads());
  return other;
}

ClipVariants<FixedPointProblem> clip_variants(const VolumePointwise& problem) {
  return {std::make_shared<const VolumePointwise>(problem.clipped(false)),
          std::make_shared<const VolumePointwise>(problem.clipped(true))};
}

Index VolumePointwise::weights(const Coordinates& x, Index node, std::span<double> out) const {
  const auto functionals = (*functionals_)[node];
  const Eigen::Matrix3d k =
      winslow_tensor(nodal_jacobian(x, node, topology().neighbours(node), functionals));
  Index negative = 0;
  for (std::size_t i = 0; i < functionals.size(); ++i) {
    out[i] = winslow_weight(k, functionals[i]);
    if (out[i] < 0) {
      ++negative;
      if (clip_) out[i] = 0;
    }
  }
  return negative;
}

/// visit(i, first free node of i's block, neighbours of node i, their weights, how many of them are
/// negative, the row) for each free node, on several threads.
template <typename Visit>
void VolumePointwise::each_row(const Coordinates& x, Visit&& visit) const {
  const auto free = node_unknowns().nodes();
  parallel_for(threads(), static_cast<Index>(free.size()), [&](Index begin, Index end) {
    std::vector<double> w;
    for (Index i = begin; i < end; ++i) {
      const auto neighbours = topology().neighbours(free[at(i)]);
      w.resize(neighbours.size());
      const Index negative = weights(x, free[at(i)], w);
      visit(i, begin, neighbours, w, negative, evaluate_row<3>(x, free[at(i)], neighbours, w));
    }
  });
}

ResidualNorms VolumePointwise::residual(const Coordinates& x, std::span<double> out) const {
  BlockNorms norms(static_cast<Index>(node_unknowns().nodes().size()));
  each_row(x, [&](Index i, Index block, auto, const auto&, Index, const NodalRowOf<3>& row) {
    norms.add(block, row.scaled());
    if (out.empty()) return;
    std::copy(row.residual.data(), row.residual.data() + 3, out.data() + 3 * at(i));
  });
  return norms.total();
}

Index VolumePointwise::freeze(const Coordinates& x, SparseSystem& out) const {
  const auto free = node_unknowns().nodes();
  SparseMatrix& matrix = out.matrix;
  matrix.pattern = pattern_->pattern;
  matrix.block = 1;
  matrix.symmetric = false;
  matrix.values.resize(matrix.pattern->columns.size());
  out.columns = 3;
  out.rhs.resize(3 * free.size());
  std::vector<Index> negative((free.size() + parallel_block - 1) / parallel_block, 0);
  each_row(x, [&](Index i, Index block, auto neighbours, const auto& w, Index count,
                  const NodalRowOf<3>& row) {
    negative[at(block / parallel_block)] += count;
    const double scale = row.scale();
    matrix.values[at(matrix.pattern->diagonal[at(i)])] =
        row.absolute_sum > 0 ? row.weight_sum * scale : 1;
    const auto first = at(topology().neighbour_rows().offsets[at(free[at(i)])]);
    for (std::size_t k = 0; k < neighbours.size(); ++k) {
      const Index entry = pattern_->entry_of_neighbour[first + k];
      if (entry >= 0) matrix.values[at(entry)] = -w[k] * scale;
    }
    for (int c = 0; c < 3; ++c)
      out.rhs[3 * at(i) + static_cast<std::size_t>(c)] = row.residual[c] * scale;
  });
  Index total = 0;
  for (const Index count : negative) total += count;
  return total;
}

void VolumePointwise::boundary_response(const Coordinates& x, const Coordinates& displacement,
                                        std::span<double> out) const {
  each_row(x, [&](Index i, Index, auto neighbours, const auto& w, Index, const NodalRowOf<3>& row) {
    Vec3 change(0, 0, 0);
    for (std::size_t k = 0; k < neighbours.size(); ++k) {
      if (pattern_->row_of_node[at(neighbours[k])] >= 0) continue;
      change += w[k] * row.scale() * displacement.xyz(neighbours[k]);
    }
    std::copy(change.data(), change.data() + 3, out.data() + 3 * at(i));
  });
}

}  // namespace winslow
