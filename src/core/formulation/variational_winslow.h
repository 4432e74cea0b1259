#pragma once

#include "core/formulation/cell_targets.h"
#include "core/formulation/row_blocks.h"
#include "core/formulation/simplex_kernel.h"
#include "core/formulation/variational_form.h"

namespace winslow {

/// Winslow smoothing as a minimisation: the harmonic energy of the inverse map, summed over
/// targets,
///
///   E = sum_t w_t psi(f_t),   psi(f) = f + (f / knee)^p,
///   f_t = |J_t|_F^2 / (2 det J_t) in the plane,   |J_t|_F^2 / (3 (det J_t)^(2/3)) in space,
///
/// where J_t maps target t linearly to its physical triangle or tetrahedron (CellTargets). f is 1
/// for a perfect match and grows to infinity where a cell degenerates: a barrier against inversion.
/// The first part of psi is Winslow's own functional (in space the mean ratio, which unlike
/// Winslow's does not depend on size) and looks after the mean; the second weighs the worst cells,
/// those with f near the knee and beyond. f does not depend on the size of either cell.
///
/// The cells of UntanglingProblem are those of the targets. Residual norms are of |R_i| over the
/// mean of the diagonal of node i's Hessian block and over its mean edge length, like the pointwise
/// form's.
template <int D>
class SimplexWinslow final : public TargetForm<D> {
 public:
  using Targets = CellTargets<D>;

  /// What comes from the connectivity and from which nodes move: the numbers of the unknowns, the
  /// pattern of the matrices, the order of the cells. Forms with other targets of the same cells
  /// share it, and with it what a linear solver has worked out for the pattern.
  struct Pattern {
    /// targets: their cells count, and the order of these.
    Pattern(std::shared_ptr<const NodeClasses> classes, const Targets& targets, int threads);

    NodeUnknowns nodes;
    std::shared_ptr<const SimplexStructure<D>> structure;
  };

  /// classes: which nodes move; those that slide have the geometry of their classes. targets: of
  /// all cells with a node that moves. threads: 0 for all cores; no result depends on it. Throws
  /// UsageError for nodes of the boundary that are free.
  SimplexWinslow(std::shared_ptr<const NodeClasses> classes, const Targets& targets,
                 const PenaltyOptions& penalty, int threads)
      : SimplexWinslow(Pattern(std::move(classes), targets, threads), targets, penalty) {}
  /// targets: of the cells that the pattern was made of, in their order. shapes() has an order of
  /// the form's own.
  SimplexWinslow(const Pattern& pattern, const Targets& targets, const PenaltyOptions& penalty);

  ResidualNorms residual(const Coordinates& x, std::span<double> out) const override;
  void boundary_response(const Coordinates& x, const Coordinates& displacement,
                         std::span<double> out) const override;
  std::shared_ptr<const VariationalForm> with_corner_lengths(const Coordinates& x) const override;
  double worst_distortion(const Coordinates& x) const override;
  std::shared_ptr<const EnergyProblem> holding_stuck_nodes(const Coordinates& x,
                                                           std::span<const double> direction,
                                                           double step) const override;
  std::unique_ptr<const TargetPath> target_path(const Coordinates& from) const override;

 private:
  struct BlockMemory;
  std::shared_ptr<TargetForm<D>> copy() const override {
    return std::make_shared<SimplexWinslow>(*this);
  }
  distortion::SimplexData data(const Coordinates& x, const Regularisation* regularisation) const;
  double energy_of(const Coordinates& x, const Regularisation* regularisation) const override {
    return this->sum_energy(data(x, regularisation));
  }
  /// D by D blocks, in the pattern of RowBlocks.
  Linearisation assemble(const Coordinates& x, const Regularisation* regularisation, bool projected,
                         SparseMatrix& hessian, std::span<double> residual) const override;
  std::vector<double> determinants(const Coordinates& x, Regularisation* held) const override;
  double sum_block(const distortion::SimplexData& data, bool is_projected, bool with_matrix,
                   Index block, BlockMemory& memory) const;
  template <typename Visit>
  void for_each_block(Visit&& visit) const;

  std::shared_ptr<const SimplexStructure<D>> structure_;
};

/// Of plane meshes, and of volume meshes.
using VariationalWinslow = SimplexWinslow<2>;
using VolumeWinslow = SimplexWinslow<3>;

}  // namespace winslow
