#include "core/strategy/variational_run.h"

#include <cmath>

namespace winslow {

void VariationalRun::relax(Coordinates& x, double fraction, const RunRecorder::Enough& enough) {
  constexpr double far = 1.5;  // knees
  constexpr int limit = 40;
  if (asked_for().exponent <= 2) return;
  const bool raised = energy().penalty().knee != asked_for().knee;
  if (!raised && energy().worst_distortion(x) < far * knee()) return;
  change_penalty({2, 0});
  recorder().iterate(newton(), x, Stage::relax, fraction, limit, enough);
  change_penalty(fitting(x));
}

const VariationalForm& VariationalRun::energy() {
  if (!energy_) energy_ = workspace().energy();
  return *energy_;
}

void VariationalRun::begin_anew() {
  energy_.reset();  // its targets may be others by now
  change_penalty(asked_for());
}

void VariationalRun::vary_targets(const Coordinates& from) {
  target_path_ = workspace().energy()->target_path(from);
}

void VariationalRun::set_target_share(double share) {
  const PenaltyOptions penalty = energy().penalty();
  energy_ = target_path_->at_share(share)->with_penalty(penalty);
  workspace().newton().set_problem(energy_);
}

void VariationalRun::change_penalty(const PenaltyOptions& penalty) {
  energy_ = energy().with_penalty(penalty);
  workspace().newton().set_problem(energy_);
}

PenaltyOptions VariationalRun::fitting(const Coordinates& x) {
  constexpr double beyond = 2;  // knees
  PenaltyOptions penalty = asked_for();
  if (penalty.knee > 0) {
    const double worst = energy().worst_distortion(x);
    while (worst > beyond * penalty.knee && std::isfinite(worst)) penalty.knee *= 2;
  }
  return penalty;
}

bool VariationalRun::sharpen(const Coordinates& x) {
  if (energy().penalty().knee == asked_for().knee) return false;
  const PenaltyOptions penalty = fitting(x);
  if (penalty.knee >= energy().penalty().knee) return false;
  change_penalty(penalty);
  return true;
}

double VariationalRun::knee() {
  constexpr double without = 2;  // where a pure power begins to be steep
  const double knee = energy().penalty().knee;
  return knee > 0 ? knee : without;
}

bool VariationalRun::strained(const Coordinates& x) {
  constexpr double beyond = 3;  // knees
  return asked_for().knee > 0 && energy().worst_distortion(x) > beyond * knee();
}

}  // namespace winslow
