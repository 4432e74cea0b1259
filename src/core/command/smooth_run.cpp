#include "core/command/smooth_run.h"

#include "core/command/picard_run.h"
#include "core/command/run_recorder.h"
#include "core/command/variational_run.h"
#include "core/command/workspace.h"
#include "core/motion/transfer.h"

namespace winslow {

namespace {

bool variational(const SmoothOptions& options) { return options.formulation == "variational"; }

/// A mesh on the way, whose boundary lies anywhere between rest and target: where to go on from.
bool usable(const MeshState& state, const Coordinates* start, int threads) {
  return start && check_validity(*state.mesh.topology, *start, threads).inverted == 0;
}

}  // namespace

SmoothResult smooth_interior(const MeshState& state, const SmoothOptions& options, Coordinates& x,
                             const ExecuteOptions& run) {
  SmoothResult result;
  SmoothingWorkspace own;
  SmoothingWorkspace& workspace = run.workspace ? *run.workspace : own;
  workspace.prepare(state.vcv, options, state.mesh.coordinates);
  RunRecorder recorder(run.monitor, result);
  if (variational(options)) {
    VariationalRun(state, workspace, recorder).smooth(x, 1, nullptr);
  } else {
    recorder.iterate(workspace.picard(), x, Stage::picard, 1, options.max_iterations);
    result.linear_solver = workspace.linear().description();
  }
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
  workspace.prepare(state.vcv, options, state.mesh.coordinates);
  RunRecorder recorder(run.monitor, result);
  if (!variational(options)) {
    move_by_fixed_point(state, motion, how.increments, options.max_iterations, workspace.picard(),
                        recorder, x);
    result.linear_solver = workspace.linear().description();
    return result;
  }
  VariationalRun steps(state, workspace, recorder);
  if (how.increments > 0) {
    steps.move_in_steps(motion, state.mesh.coordinates, how.increments, x);
  } else if (usable(state, run.start, options.threads)) {
    Coordinates target = state.mesh.coordinates;
    motion.apply(state.mesh.coordinates, 1, target);
    x = *run.start;
    steps.follow(*make_transfer(*state.mesh.topology, *run.start, target), *run.start, x);
  } else {
    x = state.mesh.coordinates;
    steps.follow(motion, state.mesh.coordinates, x);
  }
  return result;
}

}  // namespace winslow
