#pragma once

#include "core/formulation/cell_targets.h"
#include "core/formulation/variational_form.h"
#include "core/linear/linear_solver.h"
#include "core/options/option.h"
#include "core/outer/outer_solver.h"
#include "core/strategy/keep_outside.h"
#include "core/strategy/slide_options.h"

/// Every command that smooths has them; the defaults need no touch:
///
///     winslow::SmoothCommand smooth;
///     smooth.smooth.tolerance = 1e-6;
///     smooth.smooth.threads = 4;
///     state = winslow::execute(smooth, state).state;
namespace winslow {

/// Which equations a mesh is smoothed by.
enum class Formulation {
  variational,  ///< an energy with a barrier against inversion (VariationalForm)
  pointwise     ///< the paper's operator, node by node (PointwiseForm)
};
/// "variational", "pointwise".
std::string_view formulation_name(Formulation formulation);

/// How the outer iteration goes.
enum class OuterMethod {
  automatic,  ///< Newton; pointwise form: the fixed point where Newton does not end converged
  newton,     ///< Newton's method, safeguarded
  picard      ///< the paper's fixed point: coefficients frozen, damped (pointwise form only)
};

/// How a mesh with inverted elements is untangled before Newton's method can begin.
enum class Untangle {
  automatic,  ///< both: a scramble by the energy first, a moved boundary by the fixed point
  picard,     ///< damped fixed point of the pointwise form, negative weights clipped
  energy      ///< the variational form with a regularised determinant
};

/// Which virtual control volumes the interior nodes of a mesh have: what the pointwise form and the
/// targets `vcv` are over. Those of a plane mesh are equal but for the ones that were edited.
enum class VcvKind {
  automatic,    ///< equal ones of a plane mesh, adjusted ones of a volume mesh
  equal,        ///< equal angles
  existing,     ///< the solid angles of the mesh as given
  adjusted,     ///< the mean of both
  perturbation  ///< adjusted, by the paper's random perturbation
};

/// How a mesh is smoothed. The defaults need no touch. What each member means, its range and its
/// names stand in option_table().
struct SmoothOptions {
  Formulation formulation = Formulation::variational;
  TargetBlend targets;
  VcvKind vcv = VcvKind::automatic;
  double vcv_lengths = 0;  ///< VolumeVcvOptions::length_power
  int vcv_updates = 0;     ///< how often adjusted VCVs follow the mesh, at most
  PenaltyOptions penalty;
  OuterMethod outer = OuterMethod::automatic;
  Untangle untangle = Untangle::automatic;
  LinearOptions linear;
  double damping = 0.3;
  bool adapt_damping = true;
  int acceleration = 15;
  Clip clip = Clip::automatic;
  int max_iterations = 500;
  double tolerance = 1e-10;       ///< of ResidualNorms::max
  KeepOutside keep_outside = {};  ///< all nodes in it are free: none given
  SlideOptions slide = {};        ///< no node of the boundary slides
  bool raise_worst = false;       ///< then the worst element as good as it can be
  int threads = 0;
};

/// All that a user can set of them.
OptionTable option_table(SmoothOptions& options);

/// Throws UsageError naming the option that is out of range, or those that do not go together.
void validate(const SmoothOptions& options);
/// Throws UsageError, naming the option and what there is to choose, for VCVs that meshes of this
/// dimension do not have.
void validate_vcvs(const SmoothOptions& options, int cell_dimension);

/// Whether the equations are over VCVs: those of the pointwise form and of targets `vcv`.
bool refers_to_vcvs(const SmoothOptions& options);
/// Whether VCVs of a volume mesh are to be worked out anew as the mesh changes.
bool follows_mesh(VcvKind kind);

/// The table of options of a surface mesh: what such meshes refuse, and what has no effect on them,
/// does not apply.
OptionTable surface_option_table(SmoothOptions& options);

/// Puts what surface meshes refuse of options to what they have by default, or to the first choice
/// that is left.
void settle_for_surface(SmoothOptions& options);

}  // namespace winslow
