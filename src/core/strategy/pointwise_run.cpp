#include "core/strategy/pointwise_run.h"

#include "core/strategy/picard_run.h"

namespace winslow {

namespace {

bool complete(const SmoothResult& result) {
  return result.converged && result.inverted == 0 && result.fraction_reached >= 1;
}

}  // namespace

void PointwiseRun::attempt(const Way& by_newton, const Way& by_fixed_point, Coordinates& x) {
  const Coordinates start = x;
  by_newton(x);
  const SmoothResult& result = recorder().result();
  // Where a limit ended the path, a fixed point, which follows none, would run past it.
  if (complete(result) || !result.limited_by.empty() ||
      workspace().options().outer == OuterMethod::newton || recorder().remaining() <= 0) {
    return;
  }
  const SmoothResult newtons = result;
  Coordinates newtons_x = std::move(x);
  x = start;
  recorder().lift_budget();
  by_fixed_point(x);
  recorder().result().linear_solver = workspace().linear().description();
  if (result.inverted == 0 || newtons.inverted > 0) return;
  x = std::move(newtons_x);
  recorder().restore_outcome(newtons);
}

void PointwiseRun::smooth(Coordinates& x, double fraction, const Coordinates* reference) {
  attempt([&](Coordinates& y) { NewtonRun::smooth(y, fraction, reference); },
          [&](Coordinates& y) {
            recorder().iterate(workspace().picard(), y, Stage::picard, fraction,
                               workspace().options().max_iterations);
          },
          x);
}

void PointwiseRun::follow(const Motion& motion, const Coordinates& rest, Coordinates& x) {
  attempt([&](Coordinates& y) { NewtonRun::follow(motion, rest, y); },
          [&](Coordinates& y) {
            move_by_fixed_point(rest, motion, 0, workspace().options().max_iterations,
                                workspace().picard(), recorder(), y);
          },
          x);
}

void PointwiseRun::move_in_steps(const Motion& motion, const Coordinates& rest, int increments,
                                 Coordinates& x) {
  attempt([&](Coordinates& y) { NewtonRun::move_in_steps(motion, rest, increments, y); },
          [&](Coordinates& y) {
            move_by_fixed_point(rest, motion, increments, workspace().options().max_iterations,
                                workspace().picard(), recorder(), y);
          },
          x);
}

}  // namespace winslow
