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
/// The first term of psi is Winslow's own functional (in space the mean ratio, which unlike
/// Winslow's does not depend on size) and controls the mean quality. The second term controls the
/// worst cells, with f near the knee and beyond. f does not depend on the size of either cell.
///
/// The cells of UntanglingProblem are those of the targets. Residual norms are of |R_i| divided by
/// the mean diagonal entry of node i's Hessian block and by its mean edge length, as in the
/// pointwise form.
template <int D>
class SimplexWinslow final : public TargetForm<D> {
 public:
  using Targets = CellTargets<D>;

  /// Data that depend only on the connectivity and the moving nodes: the numbering of the unknowns,
  /// the pattern of the matrices, the order of the cells. Forms with other targets of the same
  /// cells share it, so a linear solver can reuse its work on the pattern.
  struct Pattern {
    /// targets: only their cells and the order of these matter.
    Pattern(std::shared_ptr<const NodeClasses> classes, const Targets& targets, int threads);

    NodeUnknowns nodes;
    std::shared_ptr<const SimplexStructure<D>> structure;
  };

  /// classes: which nodes move, with the geometry of those that slide. targets: of all cells with a
  /// moving node. threads: 0 for all cores; no result depends on it. Throws UsageError for free
  /// boundary nodes.
  SimplexWinslow(std::shared_ptr<const NodeClasses> classes, const Targets& targets,
                 const PenaltyOptions& penalty, int threads)
      : SimplexWinslow(Pattern(std::move(classes), targets, threads), targets, penalty) {}
  /// targets: of the cells of the pattern, in the same order. shapes() has the form's own order.
  SimplexWinslow(const Pattern& pattern, const Targets& targets, const PenaltyOptions& penalty);

  /// A form with other targets of some cells. If nobody else has it, its targets are not copied.
  static std::shared_ptr<const VariationalForm> with_targets(
      std::shared_ptr<const SimplexWinslow> form, const TargetsOfSome<D>& some);

  ResidualNorms residual(const Coordinates& x, std::span<double> out) const override;
  void boundary_response(const Coordinates& x, const Coordinates& displacement,
                         std::span<double> out) const override;
  std::shared_ptr<const VariationalForm> with_corner_lengths(const Coordinates& x) const override;
  std::shared_ptr<const EnergyProblem> holding_stuck_nodes(const Coordinates& x,
                                                           std::span<const double> direction,
                                                           double step) const override;
  std::unique_ptr<const TargetPath> target_path(const Coordinates& from) const override;
  Coordinates hessian_product(const Coordinates& x, const Coordinates& velocities) const override;
  void velocities_transpose(const Coordinates& x, const Coordinates& forces,
                            std::span<double> out) const override;
  /// Gradients of the energy of any cells: D numbers for each of their nodes, cell after cell.
  /// targets: of these cells; with inverse limits if the form has guards.
  std::vector<double> cell_gradients(const Coordinates& x, const Targets& targets) const;
  /// Null in the plane, and where nodes depend on others (periodic pairs, rows along curves).
  std::shared_ptr<const FirstOrderForm> first_order() const override;

 private:
  friend class VolumeFirstOrder;
  struct BlockMemory;
  double worst(const Coordinates& x, bool of_guards) const override;
  std::shared_ptr<TargetForm<D>> copy() const override {
    return std::make_shared<SimplexWinslow>(*this);
  }
  std::size_t structure_bytes() const override;
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

/// For plane meshes, and for volume meshes.
using VariationalWinslow = SimplexWinslow<2>;
using VolumeWinslow = SimplexWinslow<3>;

}  // namespace winslow
