#include "core/command/newton_run.h"

#include <algorithm>

#include "core/outer/path_follower.h"

namespace winslow {

bool NewtonRun::untangle(Coordinates& x, double fraction, const Coordinates* reference) {
  if (Untangling(state_, workspace_, recorder_).run(x, fraction, reference)) return true;
  recorder_.result().converged = false;
  return false;
}

void NewtonRun::approach(Coordinates& x, double fraction) {
  constexpr int limit = 30;
  relax(x, fraction);
  recorder_.iterate(newton(), x, Stage::relax, fraction, limit, near_enough);
}

void NewtonRun::converge(Coordinates& x, double fraction) {
  relax(x, fraction);
  recorder_.iterate(newton(), x, Stage::newton, fraction);
  recorder_.result().linear_solver = linear().description();
}

void NewtonRun::smooth(Coordinates& x, double fraction, const Coordinates* reference) {
  if (untangle(x, fraction, reference)) converge(x, fraction);
}

void NewtonRun::follow(const Motion& motion, const Coordinates& rest, Coordinates& x) {
  if (!untangle(x, 0, nullptr)) return;
  approach(x, 0);
  SteadySolver& solver = newton();
  const auto accept = [&](const IterationRecord& record, const Coordinates& at) {
    recorder_.report(record, at, Stage::path, record.fraction, true);
    return recorder_.remaining() > 0;
  };
  // Where the path is lost, the way back to it is Newton's method with the boundary held; then it
  // goes on from there. Only where that gains nothing, twice, is the motion blocked.
  constexpr double worthwhile = 1e-5;
  PathOptions options;
  double reached = 0;
  for (int failures = 0; reached < 1 && failures < 2 && recorder_.remaining() > 0;) {
    const int before = solver.linear_solves();
    const double last = reached;
    reached = PathFollower(*state_.mesh.topology, solver, options)
                  .follow(motion, rest, reached, x, accept);
    recorder_.result().linear_solves += solver.linear_solves() - before;
    if (reached >= 1) break;
    failures = reached - last > worthwhile ? 0 : failures + 1;
    Coordinates end_of_path = x;
    converge(x, reached);
    if (!recorder_.result().converged && !insists()) {
      x = std::move(end_of_path);
      recorder_.iterate(solver, x, Stage::newton, reached, 0);
      break;
    }
    options.first_step = std::min(0.02, 0.5 * (1 - reached));
    options.greedy = failures > 0;
  }
  if (reached >= 1) converge(x, reached);
}

void NewtonRun::move_in_steps(const Motion& motion, const Coordinates& rest, int increments,
                              Coordinates& x) {
  recorder_.result().increments = increments;
  for (int k = 1; k <= increments; ++k) {
    const double fraction = static_cast<double>(k) / increments;
    motion.apply(rest, fraction, x);
    if (!untangle(x, fraction, &rest)) {
      if (k < increments) continue;
      return;
    }
    if (k < increments) approach(x, fraction);
  }
  converge(x, 1);
}

}  // namespace winslow
