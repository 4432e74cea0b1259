#include "core/outer/equation_newton.h"

#include <cmath>

#include "core/error.h"
#include "core/outer/newton_step.h"

namespace winslow {

EquationNewton::EquationNewton(ClipVariants<EquationProblem> problems, LinearSolver& linear,
                               const EquationOptions& options)
    : problems_(std::move(problems)),
      linear_(linear),
      options_(options),
      residual_(problems_.plain->unknowns()),
      direction_(residual_.size()),
      frozen_direction_(residual_.size()) {
  record_.clipped = options.clip == Clip::on;
}

void EquationNewton::assess(const Coordinates& x) {
  const Validity validity = present()->validity(x);
  const bool untangled = record_.inverted > 0 && validity.inverted == 0;
  record(validity);
  if (untangled && options_.clip == Clip::automatic) record_.clipped = false;
  record_.residual = present()->residual(x, {}).max;
  if (!std::isfinite(record_.residual)) throw NumericError("the coordinates are not finite");
  if (record_.inverted == 0) round_off_ = present()->residual_round_off(x);
}

IterationRecord EquationNewton::start(const Coordinates& x) {
  begin_record(1);
  stalled_ = false;
  round_off_ = 0;
  const bool tangled = present()->validity(x).inverted > 0;
  if (tangled && options_.clip == Clip::off) {
    throw UsageError(
        "Newton's method on the unclipped pointwise equations starts from a mesh without inverted "
        "elements");
  }
  record_.clipped = options_.clip == Clip::on || tangled;
  assess(x);
  return record_;
}

void EquationNewton::factorise(const Coordinates& x) {
  linearised_.reset();
  present()->linearise(x, jacobian_, residual_);
  linear_.set_matrix(jacobian_);
  linearised_at_ = x;
  linearised_ = present();
}

void EquationNewton::solve(std::span<const double> rhs, int columns, std::span<double> out) {
  std::fill(out.begin(), out.end(), 0.0);
  record_.linear_iterations = linear_.solve(rhs, columns, out).iterations;
  ++linear_solves_;
}

bool EquationNewton::search(Coordinates& x, std::span<const double> direction, double first,
                            double smallest) {
  constexpr double armijo = 1e-4;
  const double here = present()->merit(x, merit_weights_);
  const bool valid = record_.inverted == 0;
  double t = valid ? first_valid_step(*present(), direction, first, x) : first;
  while (t >= smallest) {
    Coordinates candidate = x;
    const double move = present()->advance(direction, t, candidate);
    const double there = present()->merit(candidate, merit_weights_);
    const bool good = there <= (1 - 2 * armijo * t) * here &&
                      (!valid || present()->validity(candidate).inverted == 0);
    if (good) {
      x = std::move(candidate);
      record_.damping = t;
      record_.largest_move = move;
      return true;
    }
    t = shorter_step(t, 2 * here, there - (1 - 2 * t) * here);
  }
  return false;
}

bool EquationNewton::solve_newton(const Coordinates& x) {
  try {
    factorise(x);
    solve(residual_, 1, direction_);
    return true;
  } catch (const NumericError&) {
    linearised_.reset();
    return false;
  }
}

bool EquationNewton::search_frozen(Coordinates& x) {
  constexpr double smallest_step = 1e-2;
  present()->freeze(x, frozen_);
  linearised_.reset();
  try {
    linear_.set_matrix(frozen_.matrix);
    solve(frozen_.rhs, frozen_.columns, frozen_direction_);
  } catch (const NumericError&) {
    return false;
  }
  return search(x, frozen_direction_, options_.damping, smallest_step);
}

IterationRecord EquationNewton::step(Coordinates& x) {
  ++record_.iteration;
  if (present()->unknowns() == 0) return record_;
  // A Newton step that is cut to less than this is outside the range of its linear model.
  constexpr double short_step = 0.5;
  constexpr double smallest_step = 1e-3;
  const bool regular = solve_newton(x);
  merit_weights_ = present()->merit_weights(x);
  stalled_ = !(regular && search(x, direction_, 1, short_step)) && !search_frozen(x) &&
             !(regular && search(x, direction_, short_step, smallest_step));
  if (stalled_) record_.damping = record_.largest_move = 0;
  assess(x);
  return record_;
}

bool EquationNewton::converged() const {
  return record_.residual <= std::max(options_.tolerance, round_off_);
}

void EquationNewton::respond(const Coordinates& x, const Coordinates& displacement,
                             bool /*correct*/, std::span<double> out) {
  try {
    if (!linearised_) factorise(x);
    // Both sides use the same coordinates: only then does the mesh at a body follow it rigidly over
    // any distance.
    std::vector<double> response(out.size());
    linearised_->boundary_response(linearised_at_, displacement, response);
    solve(response, 1, out);
  } catch (const NumericError&) {  // singular: the path turns back here
    linearised_.reset();
    std::fill(out.begin(), out.end(), 0.0);
  }
}

}  // namespace winslow
