#include "core/command/variational_run.h"

#include <cmath>

namespace winslow {

void VariationalRun::relax(Coordinates& x, double fraction) {
  constexpr double far = 1.5;  // knees
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
  energy.set_penalty(fitting(x));
  newton().forget_factorisation();
}

PenaltyOptions VariationalRun::fitting(const Coordinates& x) {
  constexpr double beyond = 2;  // knees
  PenaltyOptions penalty = workspace().options().penalty;
  if (penalty.knee > 0) {
    const double worst = workspace().energy().worst_distortion(x);
    while (worst > beyond * penalty.knee && std::isfinite(worst)) penalty.knee *= 2;
  }
  return penalty;
}

bool VariationalRun::sharpen(const Coordinates& x) {
  VariationalWinslow& energy = workspace().energy();
  if (energy.penalty().knee == workspace().options().penalty.knee) return false;
  const PenaltyOptions penalty = fitting(x);
  if (penalty.knee >= energy.penalty().knee) return false;
  energy.set_penalty(penalty);
  newton().forget_factorisation();
  return true;
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
