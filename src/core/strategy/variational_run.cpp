#include "core/strategy/variational_run.h"

#include "core/error.h"

namespace winslow {

namespace {

constexpr int relaxation_limit = 40;  // iterations

}  // namespace

/// Whether first-order steps come before Newton's method.
bool VariationalRun::descends() {
  // Unknowns. Smaller meshes take a tenth of a second either way, and the factors of direct solvers
  // are exact. Measured in docs/performance.md, also on stretched meshes.
  constexpr std::size_t worthwhile = 6'000;
  const SmoothOptions& options = workspace().options();
  if (options.outer == OuterMethod::newton) return false;
  if (options.outer != OuterMethod::descent &&
      (options.linear.solver != "automatic" || energy().unknowns() < worthwhile))
    return false;
  if (energy().first_order()) return true;
  if (options.outer != OuterMethod::descent) return false;
  throw UsageError(
      "the outer method descent is for volume meshes without periodic sides and without rows of "
      "nodes that keep their spacing: choose auto or newton");
}

/// With the penalty that was asked for, so that the solution is one: no knee is raised.
bool VariationalRun::descend(Coordinates& x, double fraction, int limit,
                             const RunRecorder::Enough& enough) {
  if (on_path_ || !descends()) return false;
  if (!(energy().penalty() == asked_for())) change_penalty(asked_for());
  if (descent_) {
    descent_->set_problem(energy_);
  } else {
    descent_ = std::make_unique<EnergyDescent>(
        energy_, DescentOptions{workspace().tolerance(), workspace().options().threads});
  }
  const IterationRecord last =
      recorder().iterate(*descent_, x, Stage::descent, fraction, limit, enough);
  recorder().result().linear_solver = descent_->description();
  if (!recorder().result().converged) descent_->rest();  // Newton's method needs much memory
  return near_enough(last) && !(last.inverted > 0);
}

void VariationalRun::relax(Coordinates& x, double fraction, const RunRecorder::Enough& enough) {
  const double far = energy().has_guards() ? 3 : 1.5;  // knees
  if (asked_for().exponent <= 2 || on_path_) return;
  const bool is_as_asked = energy().penalty() == asked_for();
  if (is_as_asked && strain(x) < far) return;
  change_penalty(gentle());
  recorder().iterate(newton(), x, Stage::relax, fraction, relaxation_limit, enough);
  change_penalty(fitting(x));
  if (energy().has_guards()) lower_limits(x, fraction, enough);
}

/// Lowers raised limits of guards step by step to those asked for: unlike a raised knee, they are
/// never left raised, because the solution must not depend on the path to it.
void VariationalRun::lower_limits(Coordinates& x, double fraction,
                                  const RunRecorder::Enough& enough) {
  constexpr double step = 1.4;
  PenaltyOptions penalty = energy().penalty();
  while (penalty.raise > asked_for().raise) {
    recorder().iterate(newton(), x, Stage::relax, fraction, relaxation_limit, enough);
    penalty.raise = std::max(asked_for().raise, std::min(penalty.raise, strain(x)) / step);
    change_penalty(penalty);
  }
}

PenaltyOptions VariationalRun::gentle() {
  if (!energy().has_guards()) return {2, 0};
  // Without any guard, cells of a long path degenerate too far to be mended at its end.
  constexpr double share = 0.1;
  PenaltyOptions penalty = asked_for();
  penalty.guard *= share;
  return penalty;
}

void VariationalRun::begin_path() {
  if (!energy().has_guards()) return;
  on_path_ = true;
  change_penalty(gentle());
}

const VariationalForm& VariationalRun::energy() {
  if (!energy_) energy_ = workspace().energy();
  return *energy_;
}

void VariationalRun::begin_anew() {
  energy_.reset();  // its targets may have changed
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
  const double beyond = energy().has_guards() ? 4 : 2;  // knees
  PenaltyOptions penalty = asked_for();
  if (penalty.knee > 0) {
    const double worst = strain(x);
    while (worst > beyond * penalty.raise && std::isfinite(worst)) penalty.raise *= 2;
  }
  return penalty;
}

bool VariationalRun::sharpen(const Coordinates& x) {
  if (energy().penalty().raise == 1) return false;
  const PenaltyOptions penalty = fitting(x);
  if (penalty.raise >= energy().penalty().raise) return false;
  change_penalty(penalty);
  return true;
}

double VariationalRun::strain(const Coordinates& x) {
  constexpr double without = 2;  // distortion from which a pure power is steep
  return energy().strain(x, asked_for().knee > 0 ? asked_for().knee : without);
}

bool VariationalRun::strained(const Coordinates& x) {
  constexpr double beyond = 3;  // knees
  return !on_path_ && asked_for().knee > 0 && strain(x) > beyond * energy().penalty().raise;
}

}  // namespace winslow
