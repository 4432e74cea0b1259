#pragma once

#include <functional>

#include "core/outer/outer_solver.h"

namespace winslow {

/// Collects what a smoothing run does: numbers the outer iterations through all of its stages,
/// reports each to the monitor, and fills in the result.
class RunRecorder {
 public:
  RunRecorder(SolverMonitor* monitor, SmoothResult& result) : monitor_(monitor), result_(result) {}

  /// One record. Throws Cancelled if the monitor says so. advance: it is an outer iteration, not
  /// the assessment of a start.
  void report(IterationRecord record, const Coordinates& x, Stage stage, double fraction,
              bool advance);

  using Enough = std::function<bool(const IterationRecord&)>;
  /// Starts a solver at x and iterates until it has converged, `enough` says so, or `limit`
  /// iterations are done. Returns the last record; outcome and counts go into the result.
  IterationRecord iterate(OuterSolver& solver, Coordinates& x, Stage stage, double fraction,
                          int limit, const Enough& enough = {});

  SmoothResult& result() { return result_; }

 private:
  SolverMonitor* monitor_;
  SmoothResult& result_;
};

}  // namespace winslow
