#include "core/command/smooth_run.h"

#include <algorithm>
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

  /// Iterates until `enough` says so, the tolerance is met, or `limit` iterations are done.
  template <typename Enough>
  void iterate(Coordinates& x, double fraction, int limit, Enough&& enough) {
    IterationRecord record = report(solver_.start(x), x, fraction);
    for (int done = 0; done < limit && !solver_.converged() && !enough(record); ++done) {
      record = report(solver_.step(x), x, fraction);
      ++result_.outer_iterations;
      ++result_.linear_solves;
    }
    result_.converged = solver_.converged();
    result_.residual = record.residual;
    result_.inverted = record.inverted;
    result_.fraction_reached = fraction;
  }

  int limit() const { return options_.max_iterations; }

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

/// A tangled mesh that hardly changes any more will not come untangled.
bool hopeless(const IterationRecord& record) {
  constexpr double settled = 1e-4;
  return record.inverted > 0 && record.residual < settled;
}

/// Moves in equal steps. All but the last are smoothed loosely: they are only there to lead the
/// interior along. give_up: stop at the first step whose mesh stays tangled. Returns false then.
bool move_in_steps(const MeshState& state, const Motion& motion, int increments, bool give_up,
                   Run& run, const SmoothResult& result, Coordinates& x) {
  constexpr double loose = 1e-3;
  constexpr int step_limit = 40;
  for (int k = 1; k < increments; ++k) {
    const double fraction = static_cast<double>(k) / increments;
    motion.apply(state.mesh.coordinates, fraction, x);
    run.iterate(x, fraction, std::min(step_limit, run.limit()), [](const IterationRecord& record) {
      return record.inverted == 0 && record.residual < loose;
    });
    if (give_up && result.inverted > 0) return false;
  }
  motion.apply(state.mesh.coordinates, 1, x);
  run.iterate(x, 1, run.limit(), give_up ? hopeless : to_the_end);
  return result.inverted == 0;
}

/// At once and, where that ends tangled, in more and more steps. Where no way leads to a valid
/// mesh, the result is that of the direct way, converged or not.
void move_automatically(const MeshState& state, const Motion& motion, Run& run,
                        SmoothResult& result, Coordinates& x) {
  result.increments = 1;
  if (move_in_steps(state, motion, 1, true, run, result, x)) return;
  const Coordinates direct_x = x;
  const SmoothResult direct = result;
  constexpr std::array<int, 2> attempts{8, 32};
  for (const int increments : attempts) {
    x = state.mesh.coordinates;
    result.increments = increments;
    if (move_in_steps(state, motion, increments, true, run, result, x)) return;
  }
  x = direct_x;
  result.increments = direct.increments;
  result.converged = direct.converged;
  result.residual = direct.residual;
  result.inverted = direct.inverted;
  result.fraction_reached = direct.fraction_reached;
}

}  // namespace

SmoothResult smooth_interior(const MeshState& state, const SmoothOptions& options, Coordinates& x,
                             const ExecuteOptions& run) {
  SmoothResult result;
  SmoothingWorkspace own;
  OuterSolver& solver = (run.workspace ? *run.workspace : own).prepare(state.vcv, options);
  Run(solver, options, run.monitor, result).iterate(x, 1, options.max_iterations, to_the_end);
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
    move_in_steps(state, motion, how.increments, false, iterations, result, x);
  } else {
    move_automatically(state, motion, iterations, result, x);
  }
  return result;
}

}  // namespace winslow
