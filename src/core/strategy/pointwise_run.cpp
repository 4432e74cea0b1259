#include "core/strategy/pointwise_run.h"

namespace winslow {

namespace {

/// A tangled mesh that hardly changes any more will not be untangled.
bool hopeless(const IterationRecord& record) {
  constexpr double settled = 1e-4;
  return record.inverted > 0 && record.residual < settled;
}

class FixedPointMotion {
 public:
  FixedPointMotion(const Coordinates& rest, const Motion& motion, int max_iterations,
                   OuterSolver& solver, RunRecorder& recorder)
      : rest_(rest),
        motion_(motion),
        max_iterations_(max_iterations),
        solver_(solver),
        recorder_(recorder) {}

  /// All steps except the last are smoothed loosely: they only move the interior along. give_up:
  /// stop at the first step whose mesh stays tangled, and return false.
  bool move_in_steps(int increments, bool give_up, Coordinates& x) {
    constexpr double loose = 1e-3;
    constexpr int step_limit = 40;
    recorder_.result().increments = increments;
    for (int k = 1; k < increments; ++k) {
      const double fraction = static_cast<double>(k) / increments;
      motion_.apply(rest_, fraction, x);
      recorder_.iterate(solver_, x, Stage::picard, fraction, std::min(step_limit, max_iterations_),
                        [](const IterationRecord& record) {
                          return record.inverted == 0 && record.residual < loose;
                        });
      if (give_up && recorder_.result().inverted > 0) return false;
    }
    motion_.apply(rest_, 1, x);
    recorder_.interior_is_behind();
    recorder_.iterate(solver_, x, Stage::picard, 1, max_iterations_,
                      give_up ? RunRecorder::Enough(hopeless) : RunRecorder::Enough());
    return recorder_.result().inverted == 0;
  }

  void move_automatically(Coordinates& x) {
    if (move_in_steps(1, true, x)) return;
    const Coordinates direct_x = x;
    const RunOutcome direct = recorder_.result();
    constexpr std::array<int, 2> attempts{8, 32};
    for (const int increments : attempts) {
      x = rest_;
      if (move_in_steps(increments, true, x)) return;
    }
    x = direct_x;
    recorder_.restore_outcome(direct);
  }

 private:
  const Coordinates& rest_;
  const Motion& motion_;
  int max_iterations_;
  OuterSolver& solver_;
  RunRecorder& recorder_;
};

}  // namespace

void move_by_fixed_point(const Coordinates& rest, const Motion& motion, int increments,
                         int max_iterations, OuterSolver& solver, RunRecorder& recorder,
                         Coordinates& x) {
  FixedPointMotion run(rest, motion, max_iterations, solver, recorder);
  if (increments > 0) {
    run.move_in_steps(increments, false, x);
  } else {
    run.move_automatically(x);
  }
}

namespace {

bool complete(const SmoothResult& result) {
  return result.converged && result.inverted == 0 && result.fraction_reached >= 1;
}

}  // namespace

void PointwiseRun::attempt(const Way& by_newton, const Way& by_fixed_point, Coordinates& x) {
  const Coordinates start = x;
  by_newton(x);
  const SmoothResult& result = recorder().result();
  // If a limit ended the path, the fixed point would exceed the limit, since it follows no path.
  if (complete(result) || !result.limited_by.empty() ||
      workspace().options().outer == OuterMethod::newton || recorder().remaining() <= 0) {
    return;
  }
  const RunOutcome newtons = result;
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

void PointwiseRun::move(const Motion& motion, const Coordinates& rest, int increments,
                        Coordinates& x) {
  attempt([&](Coordinates& y) { NewtonRun::move(motion, rest, increments, y); },
          [&](Coordinates& y) {
            move_by_fixed_point(rest, motion, increments, workspace().options().max_iterations,
                                workspace().picard(), recorder(), y);
          },
          x);
}

}  // namespace winslow
