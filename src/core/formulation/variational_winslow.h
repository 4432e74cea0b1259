#pragma once

#include "core/formulation/cell_targets.h"
#include "core/formulation/row_blocks.h"
#include "core/formulation/simplex_kernel.h"
#include "core/formulation/variational_form.h"

namespace winslow {

template <int D>
struct SimplexStructure;

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
class SimplexWinslow final : public VariationalForm {
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
  /// targets: of the cells that the pattern was made of, in their order.
  SimplexWinslow(const Pattern& pattern, const Targets& targets, const PenaltyOptions& penalty);
  std::shared_ptr<const VariationalForm> with_penalty(const PenaltyOptions& penalty) const override;
  /// The same with other terms, in the order of shapes().
  std::shared_ptr<const SimplexWinslow> with_ordered_shapes(
      std::shared_ptr<const Targets> targets) const;

  std::string_view name() const override { return "variational"; }
  ResidualNorms residual(const Coordinates& x, std::span<double> out) const override;
  void boundary_response(const Coordinates& x, const Coordinates& displacement,
                         std::span<double> out) const override;
  double energy(const Coordinates& x) const override;
  /// D by D blocks, in the pattern of RowBlocks.
  Linearisation linearise(const Coordinates& x, Curvature curvature, SparseMatrix& hessian,
                          std::span<double> residual) const override;
  std::vector<double> cell_sizes(const Coordinates& x) const override;
  Regularisation regularisation(const Coordinates& x, std::span<const double> sizes,
                                double softness) const override;
  Regularisation full_regularisation(const Coordinates& x) const override;
  double regularised_energy(const Coordinates& x,
                            const Regularisation& regularisation) const override;
  Linearisation linearise_regularised(const Coordinates& x, const Regularisation& regularisation,
                                      SparseMatrix& hessian,
                                      std::span<double> residual) const override;
  std::shared_ptr<const VariationalForm> with_corner_lengths(const Coordinates& x) const override;
  double worst_distortion(const Coordinates& x) const override;
  std::shared_ptr<const EnergyProblem> holding_stuck_nodes(const Coordinates& x,
                                                           std::span<const double> direction,
                                                           double step) const override;
  Index stuck_nodes() const override;
  std::unique_ptr<const TargetPath> target_path(const Coordinates& from) const override;
  std::optional<double> stretched() const override { return shapes_->stretched; }

  /// The targets, in an order of the formulation's own.
  const Targets& shapes() const { return *shapes_; }

 private:
  struct BlockMemory;
  distortion::SimplexData data(const Coordinates& x, const Regularisation* regularisation) const;
  double energy_of(const distortion::SimplexData& cells) const;
  /// convex: the Hessian is positive semidefinite by construction, and is to stay so.
  Linearisation assemble(const distortion::SimplexData& cells, const Coordinates& x, bool project,
                         bool convex, SparseMatrix& hessian, std::span<double> residual) const;
  double sum_block(const distortion::SimplexData& data, bool is_projected, bool with_matrix,
                   Index block, BlockMemory& memory) const;
  void project(const distortion::SimplexData& data, std::span<const Index> cells,
               double* sums) const;
  template <typename Visit>
  void for_each_block(Visit&& visit) const;

  std::shared_ptr<const SimplexStructure<D>> structure_;
  std::shared_ptr<const Targets> shapes_;
  std::vector<bool> stuck_;  // #nodes with unknowns; empty: none
  const distortion::SimplexKernel<D>& kernel_ = distortion::fastest_kernel<D>();
};

template <>
std::shared_ptr<const EnergyProblem> SimplexWinslow<2>::holding_stuck_nodes(
    const Coordinates& x, std::span<const double> direction, double step) const;
template <>
std::shared_ptr<const EnergyProblem> SimplexWinslow<3>::holding_stuck_nodes(
    const Coordinates& x, std::span<const double> direction, double step) const;
extern template Index SimplexWinslow<2>::stuck_nodes() const;
extern template Index SimplexWinslow<3>::stuck_nodes() const;

/// Of plane meshes, and of volume meshes.
using VariationalWinslow = SimplexWinslow<2>;
using VolumeWinslow = SimplexWinslow<3>;

}  // namespace winslow
