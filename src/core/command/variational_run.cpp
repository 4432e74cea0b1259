#include "core/command/variational_run.h"

namespace winslow {

void VariationalRun::relax(Coordinates& x, double fraction) {
  constexpr double far = 1.5, beyond = 2;  // knees
  constexpr int limit = 40;
  VariationalWinslow& energy = workspace().energy();
  PenaltyOptions penalty = workspace().options().penalty;
  if (penalty.exponent <= 2) return;
  const bool raised = energy.penalty().knee != penalty.knee;
  energy.set_penalty(penalty);
  if (!raised && energy.worst_distortion(x) < far * knee()) return;
  energy.set_penalty({2, 0});
  newton().forget_factorisation();
  recorder().iterate(newton(), x, Stage::relax, fraction, limit, near_enough);
  if (penalty.knee > 0) {
    const double worst = energy.worst_distortion(x);
    while (worst > beyond * penalty.knee) penalty.knee *= 2;
  }
  energy.set_penalty(penalty);
  newton().forget_factorisation();
}

double VariationalRun::knee() {
  constexpr double without = 2;  // where a pure power begins to be steep
  const double knee = workspace().energy().penalty().knee;
  return knee > 0 ? knee : without;
}

bool VariationalRun::strained(const Coordinates& x) {
  constexpr double beyond = 3;  // knees
  return workspace().options().penalty.knee > 0 &&
         workspace().energy().worst_distortion(x) > beyond * knee();
}

}  // namespace winslow
