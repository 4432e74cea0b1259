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
#include "core/outer/outer_solver.h"
#include "core/outer/picard_solver.h"
#include "core/strategy/smooth_options.h"
#include "core/vcv/sphere/star_builder.h"

namespace winslow {

/// What the options of a smoothing run mean to its solvers.
inline NewtonOptions newton_options(const SmoothOptions& options) {
  return {options.tolerance, options.linear.tolerance};
}
inline EquationOptions equation_options(const SmoothOptions& options) {
  return {options.clip, options.tolerance, options.damping, options.adapt_damping,
          options.acceleration};
}

VolumeVcvOptions volume_vcv_options(const SmoothOptions& options);

/// Prepared solvers for one topology and the nodes that move: what depends on the connectivity
/// alone (matrix patterns, orderings, symbolic factorisations) outlives a command, so that a drag
/// does not pay for it at every move of the mouse, be it of a body or of a VCV. Stencil functionals
/// and target shapes are those of one set of VCVs and follow when it changes.
class SmoothingWorkspace {
 public:
  /// Says what is to be solved; parts that are still good are kept. classes: which nodes move.
  /// vcv: of a plane mesh; null for volume meshes, whose VCVs are made here, of the kind that the
  /// options say, but for those given by hand (stencils; null: none). given: the mesh that targets
  /// `auto` and `rest` and those VCVs refer to; kept by value where they do.
  void prepare(const std::shared_ptr<const VirtualControlVolumes>& vcv,
               const std::shared_ptr<const NodeClasses>& classes, const SmoothOptions& options,
               const Coordinates& given, std::shared_ptr<const SphereStencils> stencils = nullptr);

  /// From here to the next prepare() these elements count four times as much with `auto` targets,
  /// once more for each time they are listed.
  void count_more(std::vector<Index> elements);
  /// From here to the next prepare() the energy keeps the Jacobian of these elements positive
  /// between their corners, too (VolumeTargetNodes::guarded). Returns whether any of them was not
  /// among them.
  bool guard(std::span<const Index> elements);
  /// No longer guards elements of which some edge_tetrahedra() are inverted at x, a mesh that is
  /// valid all the same: its energy is to be finite. Returns whether there were any; the energy and
  /// newton() are others then.
  bool drop_guards_broken_at(const Coordinates& x);

  /// Adjusted VCVs of a volume mesh take the angles of the mesh as it is now; those of all other
  /// kinds stay. What was made over the earlier ones is made anew. Returns how many changed.
  Index adjust_vcvs(const Coordinates& x);
  /// The same where they are those of a mesh that came tangled, and x is valid: what a tangle has
  /// for angles says little. Returns whether any changed.
  bool adjust_tangled_vcvs(const Coordinates& x);

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

  const NodeClasses& classes() const { return *classes_; }
  /// Of the mesh of the run at x.
  Validity validity(const Coordinates& x) const;
  const SmoothOptions& options() const { return options_; }

 private:
  bool in_space() const { return classes_->topology().cell_dimension() == 3; }
  bool on_surface() const { return is_surface(classes_->topology()); }
  bool tangled(const Coordinates& x) const;
  const VolumeVcvs& volume_vcvs();
  void make_volume_vcvs(const Coordinates& x);
  void take_stencils(std::shared_ptr<const SphereStencils> stencils);
  const ClipVariants<EquationProblem>& pointwise();
  template <int D>
  void make_pointwise(const typename PointwiseForm<D>::Vcvs& vcvs);
  template <int D>
  void make_energy(const CellTargets<D>& targets);
  std::shared_ptr<const VariationalForm> surface_energy();
  const Coordinates* given() const { return given_ ? &*given_ : nullptr; }
  std::unique_ptr<LinearSolver> make_general_solver() const;

  std::shared_ptr<const VirtualControlVolumes> vcv_;  // of a plane mesh
  std::unique_ptr<VolumeVcvs> volume_vcvs_;           // null: not made yet
  std::shared_ptr<const SphereStencils> stencils_;    // of a volume mesh, by hand
  std::shared_ptr<const NodeClasses> classes_;
  SmoothOptions options_;
  std::optional<Coordinates> given_;         // only where something refers to it
  std::vector<Index> urgent_;                // see count_more()
  std::vector<Index> guarded_;               // see guard(); ascending
  ClipVariants<EquationProblem> pointwise_;  // null: not made yet
  std::shared_ptr<const VariationalForm> energy_;
  bool pointwise_stale_ = false, energy_stale_ = false;  // they are of other VCVs or targets
  bool tangled_vcvs_ = false;                            // adjusted to a tangled mesh
  bool adjusted_ = false;  // the VCVs are no longer those of the mesh as given
  std::unique_ptr<LinearSolver> linear_, symmetric_linear_, newton_linear_;
  std::unique_ptr<PicardSolver> picard_;
  std::unique_ptr<EnergyNewton> newton_;
  std::unique_ptr<EquationNewton> pointwise_newton_;
};

}  // namespace winslow
