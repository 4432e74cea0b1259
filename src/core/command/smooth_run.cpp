#include "core/command/smooth_run.h"

#include <array>

#include "core/command/workspace.h"
#include "core/error.h"

namespace winslow {

namespace {

/// One run of outer iterations, reported to the monitor and appended to a result.
class Run {
 public:
  Run(OuterSolver& solver, const SmoothOptions& options, SolverMonitor* monitor,
      SmoothResult& result)
      : solver_(solver), options_(options), monitor_(monitor), result_(result) {}

  /// Iterates until `enough` says so, the tolerance is met, or the limit of iterations is reached.
  template <typename Enough>
  void iterate(Coordinates& x, double fraction, Enough&& enough) {
    IterationRecord record = report(solver_.start(x), x, fraction);
    int done = 0;
    while (!solver_.converged() && done < options_.max_iterations && !enough(record)) {
      record = report(solver_.step(x), x, fraction);
      ++done;
      ++result_.outer_iterations;
      ++result_.linear_solves;
    }
    result_.converged = solver_.converged();
    result_.residual = record.residual;
    result_.inverted = record.inverted;
    result_.fraction_reached = fraction;
  }

 private:
  IterationRecord report(IterationRecord record, const Coordinates& x, double fraction) {
    // One numbering over all increments.
    record.iteration = result_.outer_iterations + (record.iteration > 0 ? 1 : 0);
    record.fraction = fraction;
    result_.history.push_back(record);
    if (monitor_ && !monitor_->on_iteration(record, x)) throw Cancelled();
    return record;
  }

  OuterSolver& solver_;
  const SmoothOptions& options_;
  SolverMonitor* monitor_;
  SmoothResult& result_;
};

bool to_the_end(const IterationRecord&) { return false; }

/// Moves in equal steps. All but the last are smoothed loosely: they are only there to lead the
/// interior along.
void move_in_steps(const MeshState& state, const Motion& motion, int increments, Run& run,
                   Coordinates& x) {
  constexpr double loose = 1e-3;
  for (int k = 1; k <= increments; ++k) {
    const double fraction = static_cast<double>(k) / increments;
    motion.apply(state.mesh.coordinates, fraction, x);
    if (k < increments) {
      run.iterate(x, fraction, [](const IterationRecord& record) {
        return record.inverted == 0 && record.residual < loose;
      });
    } else {
      run.iterate(x, fraction, to_the_end);
    }
  }
}

}  // namespace

SmoothResult smooth_interior(const MeshState& state, const SmoothOptions& options, Coordinates& x,
                             const ExecuteOptions& run) {
  SmoothResult result;
  SmoothingWorkspace own;
  OuterSolver& solver = (run.workspace ? *run.workspace : own).prepare(state.vcv, options);
  Run(solver, options, run.monitor, result).iterate(x, 1, to_the_end);
  return result;
}

SmoothResult smooth_motion(const MeshState& state, const Motion& motion, const MotionOptions& how,
                           const SmoothOptions& options, Coordinates& x,
                           const ExecuteOptions& run) {
  SmoothResult result;
  if (!how.smooth_after) {
    motion.apply(state.mesh.coordinates, 1, x);
    result.converged = true;
    result.inverted = check_validity(*state.mesh.topology, x, options.threads).inverted;
    return result;
  }
  SmoothingWorkspace own;
  SmoothingWorkspace& workspace = run.workspace ? *run.workspace : own;
  OuterSolver& solver = workspace.prepare(state.vcv, options);
  Run iterations(solver, options, run.monitor, result);
  if (how.increments > 0) {
    result.increments = how.increments;
    move_in_steps(state, motion, how.increments, iterations, x);
    return result;
  }
  constexpr std::array<int, 3> attempts{1, 8, 32};
  for (const int increments : attempts) {
    if (increments > 1) x = state.mesh.coordinates;
    result.increments = increments;
    move_in_steps(state, motion, increments, iterations, x);
    if (result.inverted == 0) break;
  }
  return result;
}

}  // namespace winslow
