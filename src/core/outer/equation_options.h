#pragma once

namespace winslow {

/// Whether negative weights of the operator are set to zero.
enum class Clip {
  automatic,  ///< while the mesh is tangled
  on,
  off
};

/// How equations without an energy are solved.
struct EquationOptions {
  Clip clip = Clip::automatic;
  double tolerance = 1e-10;  ///< of the largest scaled residual (ResidualNorms::max)
  double damping = 0.3;      ///< share of a solution with frozen coefficients that is taken, (0, 1]
  bool adapt_damping = true;  ///< halve the damping where the iteration makes no progress
  /// Earlier iterates that Anderson acceleration combines once the mesh is valid; 0: none.
  int acceleration = 15;
};

}  // namespace winslow
