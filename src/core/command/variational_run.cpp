#include "core/command/variational_run.h"

namespace winslow {

void VariationalRun::relax(Coordinates& x, double fraction) {
  constexpr double far = 1.5;  // knees
  constexpr int limit = 40;
  const PenaltyOptions& penalty = workspace().options().penalty;
  const double knee = penalty.knee > 0 ? penalty.knee : 2;
  if (penalty.exponent <= 2 || workspace().energy().worst_distortion(x) < far * knee) return;
  workspace().energy().set_penalty({2, 0});
  newton().forget_factorisation();
  recorder().iterate(newton(), x, Stage::relax, fraction, limit, near_enough);
  workspace().energy().set_penalty(penalty);
}

}  // namespace winslow
