#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "core/formulation/pointwise_winslow.h"
#include "core/formulation/target_shapes.h"
#include "core/formulation/variational_winslow.h"
#include "core/formulation/volume_targets.h"
#include "core/linear/linear_solver.h"
#include "core/outer/energy_newton.h"
#include "core/outer/equation_newton.h"
#include "core/outer/picard_solver.h"
#include "core/strategy/smooth_options.h"

namespace winslow {

/// Prepared solvers for one topology and the nodes that move: what depends on the connectivity
/// alone (matrix patterns, orderings, symbolic factorisations) outlives a command, so that a drag
/// does not pay for it at every move of the mouse, be it of a body or of a VCV. Stencil functionals
/// and target shapes are those of one set of VCVs and follow when it changes.
class SmoothingWorkspace {
 public:
  /// Says what is to be solved; parts that are still good are kept. classes: which nodes move.
  /// vcv: null for volume meshes. given: the mesh that targets `auto` and `rest` refer to; kept by
  /// value where they do. Throws UsageError.
  void prepare(const std::shared_ptr<const VirtualControlVolumes>& vcv,
               const std::shared_ptr<const NodeClasses>& classes, const SmoothOptions& options,
               const Coordinates& rest);

  /// From here to the next prepare() these elements count four times as much with `auto` targets,
  /// once more for each time they are listed.
  void count_more(std::vector<Index> elements);

  // Each is made at its first use after prepare, and valid until the next prepare.
  PicardSolver& picard();
  /// With the penalty of the options.
  std::shared_ptr<const VariationalForm> energy();
  EnergyNewton& newton();
  /// Newton's method on the formulation of the options.
  SteadySolver& steady_solver();
  EquationNewton& pointwise_newton();
  /// For the variational form's symmetric systems.
  LinearSolver& symmetric_linear();
  /// For the pointwise form's systems with frozen coefficients.
  LinearSolver& linear();
  /// For the pointwise form's Jacobians.
  LinearSolver& newton_linear();

  const VirtualControlVolumes& vcv() const { return *vcv_; }
  const NodeClasses& classes() const { return *classes_; }
  const SmoothOptions& options() const { return options_; }

 private:
  const ClipVariants<PointwiseWinslow>& pointwise();
  template <int D>
  void make_energy(const CellTargets<D>& targets);
  const Coordinates* given() const { return given_ ? &*given_ : nullptr; }
  std::unique_ptr<LinearSolver> make_general_solver() const;

  std::shared_ptr<const VirtualControlVolumes> vcv_;
  std::shared_ptr<const NodeClasses> classes_;
  SmoothOptions options_;
  std::optional<Coordinates> given_;          // only where the targets refer to it
  std::vector<Index> urgent_;                 // see count_more()
  ClipVariants<PointwiseWinslow> pointwise_;  // null: not made yet
  std::shared_ptr<const VariationalForm> energy_;
  bool pointwise_stale_ = false, energy_stale_ = false;  // they are of other VCVs or targets
  std::unique_ptr<LinearSolver> linear_, symmetric_linear_, newton_linear_;
  std::unique_ptr<PicardSolver> picard_;
  std::unique_ptr<EnergyNewton> newton_;
  std::unique_ptr<EquationNewton> pointwise_newton_;
};

}  // namespace winslow
