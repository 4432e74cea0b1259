#include "core/strategy/worst_element.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <utility>

namespace winslow {

namespace {

/// Whether the last rounds have lowered the largest distortion by enough for more of them.
class Progress {
 public:
  bool worthwhile(double worst) {
    constexpr std::size_t window = 8;
    constexpr double least = 2e-3;  // of what f is above 1
    worst_.push_back(worst);
    if (worst_.size() <= window) return true;
    const double before = worst_.front();
    worst_.pop_front();
    return before - worst > least * (before - 1);
  }

 private:
  std::deque<double> worst_;
};

}  // namespace

void raise_worst_element(SmoothingWorkspace& workspace, RunRecorder& recorder, double fraction,
                         Coordinates& x) {
  constexpr int steps = 3;                  // of Newton's method in a round
  constexpr double closer = 0.5, away = 3;  // what the bound's distance becomes, round by round
  constexpr double farthest = 2;            // bound, in largest distortions
  constexpr double short_step = 0.2, settled = 1e-3;
  const SmoothResult outcome = recorder.result();
  EnergyNewton& newton = workspace.newton();
  auto energy = workspace.energy()->with_corner_lengths(x);
  double worst = energy->worst_distortion(x);
  if (!std::isfinite(worst)) return;
  Coordinates best = x;
  double best_sine = workspace.validity(x).min_sine, bound = farthest * worst;
  Progress progress;
  do {
    energy = energy->with_penalty({.exponent = 1, .knee = 0, .bound = bound});
    newton.set_problem(energy);
    bool begun = false;  // a round takes one step at least
    const auto enough = [&](const IterationRecord& record) {
      return std::exchange(begun, true) && record.residual < settled;
    };
    const IterationRecord last = recorder.iterate(newton, x, Stage::worst, fraction, steps, enough);
    if (last.min_sine > best_sine) {
      best = x;
      best_sine = last.min_sine;
    }
    energy = energy->with_corner_lengths(x);
    worst = energy->worst_distortion(x);
    const bool free = !newton.stalled() && last.damping > short_step;
    bound = worst + (free ? closer : away) * (bound - worst);
    bound = std::min(bound, farthest * worst);
  } while (recorder.remaining() > 0 && progress.worthwhile(worst));
  x = std::move(best);
  recorder.restore_outcome(outcome);
}

}  // namespace winslow
