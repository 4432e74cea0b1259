#pragma once

#include "core/formulation/cell_targets.h"
#include "core/formulation/variational_form.h"
#include "core/linear/linear_solver.h"
#include "core/options/option.h"
#include "core/outer/outer_solver.h"
#include "core/strategy/keep_outside.h"
#include "core/strategy/slide_options.h"

/// Options of every command that smooths; the defaults suit most meshes:
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

/// The method of the outer iteration.
enum class OuterMethod {
  automatic,  ///< Newton, after first-order steps where these pay; pointwise form: the fixed point
              ///< if Newton does not converge
  newton,     ///< Newton's method, safeguarded
  descent,    ///< first-order steps, then Newton if these do not end converged (volume meshes)
  picard      ///< the paper's fixed point: coefficients frozen, damped (pointwise form only)
};

/// How a mesh with inverted elements is untangled before Newton's method can begin.
enum class Untangle {
  automatic,  ///< both: for a scramble the energy first, for a moved boundary the fixed point
  picard,     ///< damped fixed point of the pointwise form, negative weights clipped
  energy      ///< the variational form with a regularised determinant
};

/// The virtual control volumes of the interior nodes, on which the pointwise form and the targets
/// `vcv` are based. In a plane mesh all are equal except the edited ones.
enum class VcvKind {
  automatic,    ///< equal ones of a plane mesh, adjusted ones of a volume mesh
  equal,        ///< equal angles
  existing,     ///< the solid angles of the mesh as given
  adjusted,     ///< the mean of both
  perturbation  ///< adjusted, by the paper's random perturbation
};

/// How a mesh is smoothed. The defaults suit most meshes. option_table() documents the meaning,
/// range and names of each member.
struct SmoothOptions {
  Formulation formulation = Formulation::variational;
  TargetBlend targets;
  VcvKind vcv = VcvKind::automatic;
  double vcv_lengths = 0;  ///< VolumeVcvOptions::length_power
  int vcv_updates = 0;     ///< most updates of adjusted VCVs to the changed mesh
  PenaltyOptions penalty;
  OuterMethod outer = OuterMethod::automatic;
  Untangle untangle = Untangle::automatic;
  LinearOptions linear;
  double damping = 0.3;
  bool adapt_damping = true;
  int acceleration = 15;
  Clip clip = Clip::automatic;
  int max_iterations = 1000;
  std::optional<double> tolerance = {};  ///< of ResidualNorms::max; none: default_tolerance()
  KeepOutside keep_outside = {};         ///< default: no region, all interior nodes are free
  SlideOptions slide = {};               ///< default: no boundary node slides
  bool raise_worst = false;              ///< finally raise the worst element as far as possible
  int threads = 0;
};

/// The tolerance of runs that are given none, on meshes of this cell dimension: 1e-4 for volume
/// meshes, 1e-10 for plane and surface meshes. In space the last solves are the dearest, and from
/// 1e-4 on they change no digit of the quality that is shown (docs/performance.md).
double default_tolerance(int cell_dimension);
/// The tolerance in effect on meshes of this cell dimension: the one given, else the default.
double tolerance_of(const SmoothOptions& options, int cell_dimension);
/// These options with a tolerance of 1e-10 where none is given, for runs that begin from the result
/// of another one: where the mesh of a body must not depend on the way there, a mesh near the
/// solution is not enough.
SmoothOptions independent_of_start(SmoothOptions options);

/// All options that a user can set.
OptionTable option_table(SmoothOptions& options);
/// The rows for meshes of one kind, with the default tolerance of such meshes. For surface meshes
/// this is surface_option_table().
OptionTable option_table(SmoothOptions& options, MeshKind kind);

/// Throws UsageError naming the option that is out of range, or the options that are incompatible.
void validate(const SmoothOptions& options);
/// Throws UsageError, naming the option and the available choices, for VCVs that meshes of this
/// dimension do not have.
void validate_vcvs(const SmoothOptions& options, int cell_dimension);

/// Whether the equations depend on VCVs: the pointwise form and the targets `vcv` do.
bool refers_to_vcvs(const SmoothOptions& options);
/// Whether VCVs of a volume mesh are recomputed as the mesh changes.
bool follows_mesh(VcvKind kind);

/// The table of options for a surface mesh: options that such meshes refuse, or that have no effect
/// on them, are marked as not applicable.
OptionTable surface_option_table(SmoothOptions& options);

/// Sets options that surface meshes refuse to their defaults, or to the first choice that applies.
void settle_for_surface(SmoothOptions& options);

}  // namespace winslow
