#pragma once

#include <string>

#include "core/linear/linear_solver.h"

namespace winslow {

/// Whether negative weights of the operator are set to zero.
enum class Clip {
  automatic,  ///< while the mesh is tangled
  on,
  off
};

/// How a mesh is smoothed. The defaults need no touch.
struct SmoothOptions {
  std::string formulation = "pointwise";  ///< one of formulation_names()
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
