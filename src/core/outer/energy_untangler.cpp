#include "core/outer/energy_untangler.h"

#include "core/outer/newton_step.h"

namespace winslow {

namespace {

/// Least Softness::of_inverted. Below it steps lead nowhere.
constexpr double sharpest = 1e-5;

}  // namespace

EnergyUntangler::EnergyUntangler(std::shared_ptr<const UntanglingProblem> problem,
                                 LinearSolver& linear, double linear_tolerance,
                                 const Coordinates* reference, Interior interior)
    : problem_(std::move(problem)),
      linear_(linear),
      linear_tolerance_(linear_tolerance),
      reference_(reference),
      interior_(interior) {}

/// Relative residual for the next linear solve.
double EnergyUntangler::forcing() const {
  // In the plane the error of a looser solve may exceed the size of the triangles at a small body.
  // In space a looser solve needs as many steps, each in half the time; but the harmonic step is a
  // single one and must be accurate.
  constexpr double accurate = 1e-6, loosening = 10, loosest = 0.1;
  const bool may_be_loose = hessian_.block == 3 && !harmonic_step();
  return may_be_loose ? std::min(loosening * linear_tolerance_, loosest)
                      : std::min(linear_tolerance_, accurate);
}

/// Measures the sizes once. If they were measured again as the mesh changes, the regularisation
/// would shrink with the cells of approaching nodes, and these could collapse to one point.
void EnergyUntangler::measure_sizes(const Coordinates& x) {
  sizes_ = problem_->cell_sizes(reference_ ? *reference_ : x);
}

void EnergyUntangler::choose_regularisation(const Coordinates& x) {
  regularisation_ = harmonic_step() ? problem_->full_regularisation(x)
                                    : problem_->regularisation(x, sizes_, softness_);
}

/// A soft determinant untangles the bulk, a sharp one the last few elements. Inverted cells get
/// sharper only where the mesh comes to rest: while nodes still move far, their number says
/// nothing.
void EnergyUntangler::sharpen(bool at_rest) {
  constexpr double sharpening = 0.25;
  softness_.of_size *= sharpening;
  if (at_rest) softness_.of_inverted *= sharpening;
  last_progress_ = record_.iteration;
}

void EnergyUntangler::assess(const Coordinates& x) {
  record(problem_->validity(x));
  constexpr int patience = 8, least = 3;
  constexpr double at_rest = 0.03, settled = 1e-4;  // residuals
  const int waited = record_.iteration - last_progress_;
  if (record_.inverted < least_inverted_) {
    least_inverted_ = record_.inverted;
    last_progress_ = record_.iteration;
  } else if (waited >= patience || (waited >= least && record_.residual < settled)) {
    sharpen(record_.residual < at_rest);
  }
}

bool EnergyUntangler::stalled() const { return softness_.of_inverted < sharpest; }

IterationRecord EnergyUntangler::start(const Coordinates& x) {
  begin_record(1);
  softness_ = {};
  least_inverted_ = std::numeric_limits<Index>::max();
  last_progress_ = 0;
  measure_sizes(x);
  assess(x);
  choose_regularisation(x);
  std::vector<double> residual(problem_->unknowns());
  record_.residual =
      problem_->linearise_regularised(x, regularisation_, hessian_, residual).norms.max;
  return record_;
}

/// Returns the slope of the energy along the direction, downhill.
double EnergyUntangler::solve_for_direction(const Coordinates& x) {
  std::vector<double> residual(problem_->unknowns());
  direction_.assign(residual.size(), 0.0);
  record_.residual =
      problem_->linearise_regularised(x, regularisation_, hessian_, residual).norms.max;
  linear_.set_tolerance(forcing());
  record_.linear_iterations = solve_shifted(linear_, hessian_, residual, direction_).iterations;
  ++linear_solves_;
  double slope = 0;
  for (std::size_t i = 0; i < residual.size(); ++i) slope += residual[i] * direction_[i];
  return slope;
}

bool EnergyUntangler::search(Coordinates& x, double slope, double shortest) {
  constexpr double armijo = 1e-4;
  constexpr int most_trials = 20;
  const double energy = problem_->regularised_energy(x, regularisation_);
  double t = 1;
  for (int trial = 0; trial < most_trials && t >= shortest; ++trial, t *= 0.5) {
    Coordinates candidate = x;
    const double move = problem_->advance(direction_, t, candidate);
    // The minimum of a quadratic form needs no search; round-off would end a search if x is already
    // the minimum.
    if (!harmonic_step() &&
        problem_->regularised_energy(candidate, regularisation_) > energy - armijo * t * slope) {
      continue;
    }
    x = std::move(candidate);
    record_.damping = t;
    record_.largest_move = move;
    return true;
  }
  return false;
}

IterationRecord EnergyUntangler::step(Coordinates& x) {
  ++record_.iteration;
  if (interior_ == Interior::harmonic && record_.iteration == 2) {
    measure_sizes(x);
    least_inverted_ = record_.inverted;
    last_progress_ = 1;
  }
  choose_regularisation(x);
  const double slope = solve_for_direction(x);
  const bool lower = search_down(
      problem_, x, direction_, slope, [&] { pass_checkpoint(); },
      [&] { return solve_for_direction(x); },
      [&](double down, double shortest) { return search(x, down, shortest); });
  if (lower) {
    assess(x);
  } else {
    record_.damping = record_.largest_move = 0;
    sharpen(true);
  }
  return record_;
}

}  // namespace winslow
