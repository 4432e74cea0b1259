#include "core/outer/energy_newton.h"

#include <cmath>

#include "core/error.h"
#include "core/outer/newton_step.h"

namespace winslow {

namespace {

double dot(std::span<const double> a, std::span<const double> b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

}  // namespace

EnergyNewton::EnergyNewton(std::shared_ptr<const EnergyProblem> problem, LinearSolver& linear,
                           const NewtonOptions& options, std::vector<double> memory)
    : problem_(std::move(problem)),
      linear_(linear),
      options_(options),
      residual_(problem_->unknowns()),
      direction_(problem_->unknowns()),
      tight_(std::min(options.linear_tolerance, 1e-6)) {
  hessian_.values = std::move(memory);
  linear_.set_tolerance(tight_);
}

/// Relative residual for the linear solve of the next step. Far from the solution the linear model
/// justifies only one digit more than the residual. The tolerance decreases with the residual, so
/// the final iterations converge as fast as with exact solves, and the last step need only reach
/// the tolerance. But if an element is near inversion, the matrix entries differ by many orders of
/// magnitude, and a loose residual may leave the critical part unsolved.
double EnergyNewton::forcing() const {
  constexpr double share = 0.1, loosest = 1e-2;
  if (slender() || record_.damping < 1) return tight_;
  const double enough = 0.3 * options_.tolerance / record_.residual;
  return std::clamp(std::max(share * record_.residual, enough), tight_, std::max(tight_, loosest));
}

void EnergyNewton::assess(const Coordinates& x) {
  record(validity_);
  record_.residual = problem_->residual(x, {}).max;
  round_off_ = problem_->residual_round_off(x);
}

IterationRecord EnergyNewton::start(const Coordinates& x) {
  begin_record(1);
  stalled_ = false;
  reached_.clear();
  energy_ = problem_->energy(x);
  if (!std::isfinite(energy_)) {
    throw UsageError("Newton's method on the energy starts from a mesh without inverted elements");
  }
  validity_ = problem_->validity(x);
  assess(x);
  return record_;
}

void EnergyNewton::factorise(const Coordinates& x) {
  // Far from the solution the exact Hessian is usually indefinite. Detecting this costs a
  // factorisation, and an inexact solver may never detect it. If the last one was indefinite, the
  // next one usually is too, until full steps are accepted again.
  constexpr double far = 0.1, close = 0.05;  // scaled residual
  const bool try_exact = record_.residual <= far && (exact_ || record_.damping >= 1);
  if (!try_exact || !factorise_exact(x, record_.residual <= close)) factorise_projected(x);
}

bool EnergyNewton::factorise_exact(const Coordinates& x, bool may_raise) {
  // This near to the solution the last exact Hessian is still a good preconditioner: it saves 10 %
  // of the time of a motion with Cholesky factors, 3 % with multigrid. Further away it costs more.
  constexpr double near = 0.01;  // scaled residual
  const bool keep = linearised() && exact_ && record_.residual <= near && !slender();
  linearised_.reset();
  linearised_at_ = x;
  problem_->linearise(x, Curvature::exact, hessian_, residual_);
  exact_ = try_matrix(keep);
  if (exact_ || !may_raise) return exact_;
  for (const double share : {1e-4, 1e-2}) {
    shift_diagonal(hessian_, share);
    if (try_matrix(false)) return true;
  }
  return false;
}

bool EnergyNewton::try_matrix(bool keep) {
  try {
    linear_.set_matrix(hessian_, keep);
    linearised_ = problem_;
  } catch (const NotPositiveDefinite&) {
    linearised_.reset();
  }
  return linearised();
}

void EnergyNewton::factorise_projected(const Coordinates& x) {
  exact_ = false;
  linearised_at_ = x;
  problem_->linearise(x, Curvature::projected, hessian_, residual_);
  set_shifted_matrix(linear_, hessian_);
  linearised_ = problem_;
}

/// Returns the rate of decrease of the energy along the direction.
double EnergyNewton::solve_for_direction(const Coordinates& x) {
  factorise(x);
  std::fill(direction_.begin(), direction_.end(), 0.0);
  ++linear_solves_;
  try {
    record_.linear_iterations = linear_.solve(residual_, 1, direction_).iterations;
    if (const double slope = dot(residual_, direction_); slope > 0) return slope;
  } catch (const NotPositiveDefinite&) {
    // An iterative solver detects an indefinite matrix only now.
  }
  factorise_projected(x);
  ++linear_solves_;
  record_.linear_iterations = solve_shifted(linear_, hessian_, residual_, direction_).iterations;
  return dot(residual_, direction_);
}

EnergyNewton::Trial EnergyNewton::attempt(const Coordinates& x, double t) const {
  Trial trial{x, t, 0, 0};
  trial.move = problem_->advance(direction_, t, trial.x);
  trial.energy = problem_->energy(trial.x);
  return trial;
}

/// After a full step with the projected Hessian, tries a longer one that lowers the energy further.
/// The projection removes negative curvature, so the model is too stiff: by a third in the first
/// steps on generated meshes.
void EnergyNewton::lengthen(const Coordinates& x, double slope, Trial& trial) const {
  constexpr double worthwhile = 1.2, longest = 2;
  const double t = std::min(longest, longer_step(slope, trial.energy - energy_));
  if (exact_ || trial.t != 1 || !(t > worthwhile)) return;
  Trial longer = attempt(x, first_valid_step(*problem_, direction_, t, x));
  if (longer.t > 1 && longer.energy < trial.energy) trial = std::move(longer);
}

bool EnergyNewton::search(Coordinates& x, double slope, double shortest) {
  constexpr double armijo = 1e-4;
  constexpr double flat = 1e-11;  // relative change of the energy that round-off can cause
  constexpr int most_trials = 30;
  double t = first_valid_step(*problem_, direction_, 1, x);
  for (int i = 0; i < most_trials && t >= shortest; ++i) {
    Trial trial = attempt(x, t);
    lengthen(x, slope, trial);
    bool good = trial.energy <= energy_ - armijo * trial.t * slope;
    if (!good && std::abs(trial.energy - energy_) <= flat * energy_) {
      good = problem_->residual(trial.x, {}).max < record_.residual;
    }
    // The energy is a barrier only at the corners of elements: the Jacobian of a hexahedron can
    // change its sign inside first.
    const Validity validity = good ? problem_->validity(trial.x) : Validity{};
    if (good && (validity.inverted == 0 || record_.inverted > 0)) {
      x = std::move(trial.x);
      validity_ = validity;
      energy_ = trial.energy;
      record_.damping = trial.t;
      record_.largest_move = trial.move;
      return true;
    }
    t = shorter_step(t, slope, trial.energy - energy_ + t * slope);
  }
  return false;
}

/// If the model holds, a step with share t lowers the energy by about t times the slope. If the
/// energy has kinks that holding nodes does not remove (thousands of surface folds between
/// slivers), line searches continue forever with decreasing gain. Therefore: the iteration
/// stagnates if all steps of a window together gained less than a tenth of the gain predicted for
/// the next step, and the residual did not decrease by a tenth.
bool EnergyNewton::stagnates(double slope) const {
  constexpr std::ptrdiff_t window = 40;
  constexpr double worthwhile = 0.1;
  if (std::ssize(reached_) <= window) return false;
  const auto first = reached_.end() - window;  // of the window
  if ((first - 1)->energy - reached_.back().energy >= worthwhile * slope) return false;
  const auto lowest = [](auto begin, auto end) {
    return std::ranges::min_element(begin, end, {}, &Reached::residual)->residual;
  };
  return lowest(first, reached_.end()) > (1 - worthwhile) * lowest(reached_.begin(), first);
}

IterationRecord EnergyNewton::step(Coordinates& x) {
  ++record_.iteration;
  if (problem_->unknowns() == 0) return record_;
  linear_.set_tolerance(forcing());
  const double slope = solve_for_direction(x);
  linear_.set_tolerance(tight_);  // for a long motion, the error of a looser solve would exceed the
                                  // size of small elements
  stalled_ = !search_down(
      problem_, x, direction_, slope, [&] { pass_checkpoint(); },
      [&] { return solve_for_direction(x); },
      [&](double down, double shortest) { return search(x, down, shortest); });
  if (stalled_) record_.damping = record_.largest_move = 0;
  assess(x);
  reached_.push_back({energy_, record_.residual});
  stalled_ = stalled_ || stagnates(slope);
  return record_;
}

bool EnergyNewton::converged() const {
  return record_.residual <= std::max(options_.tolerance, round_off_);
}

void EnergyNewton::respond(const Coordinates& x, const Coordinates& displacement, bool correct,
                           std::span<double> out) {
  if (!linearised() || !exact_) {
    if (!factorise_exact(x, true)) factorise_projected(x);
  }
  // Both sides use the same coordinates: only then does the mesh at a body follow it rigidly over
  // any distance.
  std::vector<double> response(out.size());
  problem_->boundary_response(linearised_at_, displacement, response);
  if (correct) {
    std::vector<double> rest = residual_;
    if (!(linearised_at_ == x)) problem_->residual(x, rest);
    for (std::size_t i = 0; i < rest.size(); ++i) response[i] += rest[i];
  }
  std::fill(out.begin(), out.end(), 0.0);
  ++linear_solves_;
  try {
    linear_.solve(response, 1, out);
  } catch (const NotPositiveDefinite&) {
    factorise_projected(linearised_at_);
    solve_shifted(linear_, hessian_, response, out);
  }
}

}  // namespace winslow
