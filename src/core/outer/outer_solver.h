#pragma once

#include <string_view>

#include "core/index.h"
#include "core/mesh/coordinates.h"

namespace winslow {

/// What an outer iteration was part of.
enum class Stage {
  picard,    ///< fixed-point iteration
  untangle,  ///< towards a mesh without inverted elements
  relax,     ///< getting near a solution before the path or the last steps
  path,      ///< following the boundary's motion
  newton,    ///< Newton's method towards the tolerance
  worst      ///< raising the worst element of a solution
};
std::string_view stage_name(Stage stage);  ///< "picard", "untangle", ...

/// One row of a convergence history. Iteration 0 is the mesh as given.
struct IterationRecord {
  int iteration = 0;
  double residual = 0;      ///< ResidualNorms::max after the iteration
  double largest_move = 0;  ///< of any node, in units of the mesh
  Index inverted = 0;       ///< elements
  double min_sine = 0;      ///< smallest normalized Jacobian
  double damping = 0;       ///< as used
  bool clipped = false;     ///< negative weights were set to zero
  int linear_iterations = 0;
  double fraction = 1;  ///< share of the boundary motion applied so far
  Stage stage = Stage::picard;
};

/// Drives a problem towards a solution, one outer iteration at a time.
class OuterSolver {
 public:
  virtual ~OuterSolver() = default;
  /// Assesses coordinates without changing them (iteration 0), e.g. after the boundary moved.
  virtual IterationRecord start(const Coordinates& x) = 0;
  /// One outer iteration.
  virtual IterationRecord step(Coordinates& x) = 0;
  /// True if the last record meets the tolerance, also on a mesh whose solution is tangled.
  virtual bool converged() const = 0;
  /// True if the last step made no headway and further ones would not either.
  virtual bool stalled() const { return false; }
  /// Nodes that it holds where what they slide on folds (EnergyProblem::holding_stuck_nodes()).
  virtual Index stuck_nodes() const { return 0; }
  /// Linear systems solved since the solver was made.
  virtual int linear_solves() const = 0;
};

}  // namespace winslow
