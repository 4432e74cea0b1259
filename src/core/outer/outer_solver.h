#pragma once

#include <memory>
#include <vector>

#include "core/formulation/formulation.h"
#include "core/outer/smooth_options.h"
#include "core/quality/quality.h"

namespace winslow {

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
};

/// Told about every outer iteration, on the solver's thread.
class SolverMonitor {
 public:
  virtual ~SolverMonitor() = default;
  /// May block (pause). Returns false to cancel: the solver then throws Cancelled.
  virtual bool on_iteration(const IterationRecord& record, const Coordinates& coordinates) = 0;
};

/// Drives a formulation towards a solution, one outer iteration at a time.
class OuterSolver {
 public:
  virtual ~OuterSolver() = default;
  /// Assesses coordinates without changing them (iteration 0), e.g. after the boundary moved.
  virtual IterationRecord start(const Coordinates& x) = 0;
  /// One outer iteration.
  virtual IterationRecord step(Coordinates& x) = 0;
  /// True if the last record meets the tolerance, also on a mesh whose solution is tangled.
  virtual bool converged() const = 0;
};

/// What a smoothing run came to.
struct SmoothResult {
  bool converged = false;
  int outer_iterations = 0;
  int linear_solves = 0;
  double residual = 0;
  double fraction_reached = 1;  ///< share of the boundary motion in the result
  int increments = 1;           ///< steps in which the boundary was moved
  Index inverted = 0;
  std::vector<IterationRecord> history;
};

}  // namespace winslow
