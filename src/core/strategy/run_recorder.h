#pragma once

#include <functional>
#include <limits>

#include "core/strategy/run.h"

namespace winslow {

/// Collects what a smoothing run does: numbers the outer iterations through all of its stages,
/// reports each to the monitor, and fills in the result.
class RunRecorder {
 public:
  /// budget: outer iterations that all stages may take together.
  RunRecorder(SolverMonitor* monitor, SmoothResult& result, int budget)
      : monitor_(monitor), result_(result), budget_(budget) {}

  /// One record. Throws Cancelled if the monitor says so. advance: it is an outer iteration, not
  /// the assessment of a start.
  void report(IterationRecord record, const Coordinates& x, Stage stage, double fraction,
              bool advance);

  using Enough = std::function<bool(const IterationRecord&)>;
  /// Starts a solver at x and iterates until it has converged, `enough` says so, `limit`
  /// iterations are done, or the budget is spent. Returns the last record; outcome and counts go
  /// into the result.
  IterationRecord iterate(OuterSolver& solver, Coordinates& x, Stage stage, double fraction,
                          int limit, const Enough& enough = {});
  IterationRecord iterate(OuterSolver& solver, Coordinates& x, Stage stage, double fraction,
                          const Enough& enough = {}) {
    return iterate(solver, x, stage, fraction, budget_, enough);
  }

  /// Outer iterations left of the budget.
  int remaining() const { return budget_ - result_.outer_iterations; }
  /// From here on stages have their own limits only.
  void lift_budget() { budget_ = std::numeric_limits<int>::max(); }

  SmoothResult& result() { return result_; }
  /// Puts back how an earlier attempt ended; counts and history stay those of all attempts.
  void restore_outcome(const SmoothResult& earlier);

 private:
  SolverMonitor* monitor_;
  SmoothResult& result_;
  int budget_;
};

}  // namespace winslow
