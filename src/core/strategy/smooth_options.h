#pragma once

#include <string>

#include "core/formulation/variational_winslow.h"
#include "core/linear/linear_solver.h"
#include "core/outer/equation_options.h"

namespace winslow {

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

/// How a mesh is smoothed. The defaults need no touch.
struct SmoothOptions {
  std::string formulation = "variational";  ///< one of formulation_names()
  TargetBlend targets;     ///< variational: shapes that the elements are driven towards
  PenaltyOptions penalty;  ///< variational: how much more the worst elements count
  OuterMethod outer = OuterMethod::automatic;
  Untangle untangle = Untangle::automatic;
  LinearOptions linear;
  double damping = 0.3;       ///< share of each linear solution that is taken, (0, 1]
  bool adapt_damping = true;  ///< halve the damping where the iteration makes no progress
  /// Earlier iterates that Anderson acceleration combines once the mesh is valid; 0: none, the
  /// plain iteration of the paper.
  int acceleration = 15;
  Clip clip = Clip::automatic;
  int max_iterations = 500;  ///< outer iterations
  double tolerance = 1e-10;  ///< of the largest scaled residual (ResidualNorms::max)
  int threads = 0;           ///< 0 for all cores; the result does not depend on it
};

/// Throws UsageError naming the option that is out of range.
void validate(const SmoothOptions& options);

}  // namespace winslow
