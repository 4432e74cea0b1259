#include "core/outer/pointwise_newton.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/outer/advance.h"
#include "core/outer/round_off.h"
#include "core/quality/quality.h"

namespace winslow {

PointwiseNewton::PointwiseNewton(const Topology& topology, const PointwiseWinslow& formulation,
                                 LinearSolver& linear, const SmoothOptions& options)
    : topology_(topology),
      formulation_(formulation),
      linear_(linear),
      options_(options),
      residual_(2 * topology.free_nodes().size()),
      direction_(2 * topology.free_nodes().size()),
      frozen_direction_(2 * topology.free_nodes().size()),
      merit_weights_(topology.free_nodes().size()),
      scratch_(2 * topology.free_nodes().size()) {
  record_.clipped = options.clip == Clip::on;
}

void PointwiseNewton::assess(const Coordinates& x) {
  const Validity validity = check_validity(topology_, x, options_.threads);
  const bool untangled = record_.inverted > 0 && validity.inverted == 0;
  record_.inverted = validity.inverted;
  record_.min_sine = validity.min_sine;
  if (untangled && options_.clip == Clip::automatic) record_.clipped = false;
  record_.residual = formulation_.residual(x, record_.clipped, {}).max;
  if (!std::isfinite(record_.residual)) throw NumericError("the coordinates are not finite");
  if (record_.inverted == 0) round_off_ = residual_round_off(topology_, x);
}

IterationRecord PointwiseNewton::start(const Coordinates& x) {
  record_ = {};
  record_.damping = 1;
  stalled_ = false;
  round_off_ = 0;
  const bool tangled = check_validity(topology_, x, options_.threads).inverted > 0;
  if (tangled && options_.clip == Clip::off) {
    throw UsageError(
        "Newton's method on the unclipped pointwise equations starts from a mesh without inverted "
        "elements");
  }
  record_.clipped = options_.clip == Clip::on || tangled;
  assess(x);
  return record_;
}

void PointwiseNewton::factorise(const Coordinates& x) {
  factorised_ = false;
  formulation_.linearise(x, record_.clipped, jacobian_, residual_);
  linear_.set_matrix(jacobian_);
  factorised_at_ = x;
  factorised_clipped_ = record_.clipped;
  factorised_ = true;
}

void PointwiseNewton::solve(std::span<const double> rhs, int columns, std::span<double> out) {
  std::fill(out.begin(), out.end(), 0.0);
  record_.linear_iterations = linear_.solve(rhs, columns, out).iterations;
  ++linear_solves_;
}

void PointwiseNewton::weigh(const Coordinates& x) {
  formulation_.row_scales(x, record_.clipped, merit_weights_);
  const auto free = topology_.free_nodes();
  for (std::size_t i = 0; i < free.size(); ++i) {
    const double edge = mean_edge(topology_, x, free[i]);
    if (edge > 0) merit_weights_[i] /= edge;
  }
}

double PointwiseNewton::merit(const Coordinates& x) {
  formulation_.residual(x, record_.clipped, scratch_);
  double sum = 0;
  for (std::size_t i = 0; i < merit_weights_.size(); ++i) {
    const Vec2 r(scratch_[2 * i], scratch_[2 * i + 1]);
    sum += merit_weights_[i] * merit_weights_[i] * r.squaredNorm();
  }
  return sum;
}

bool PointwiseNewton::search(Coordinates& x, std::span<const double> direction, double first,
                             double smallest) {
  constexpr double armijo = 1e-4;
  const double here = merit(x);
  const bool valid = record_.inverted == 0;
  double t = valid ? first_valid_step(topology_, direction, first, x, options_.threads) : first;
  while (t >= smallest) {
    Coordinates candidate = x;
    const double move = advance(topology_, direction, t, candidate);
    const double there = merit(candidate);
    const bool good =
        there <= (1 - 2 * armijo * t) * here &&
        (!valid || check_validity(topology_, candidate, options_.threads).inverted == 0);
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

bool PointwiseNewton::solve_newton(const Coordinates& x) {
  try {
    factorise(x);
    solve(residual_, 1, direction_);
    return true;
  } catch (const NumericError&) {
    factorised_ = false;
    return false;
  }
}

bool PointwiseNewton::search_frozen(Coordinates& x) {
  constexpr double smallest_step = 1e-2;
  formulation_.freeze(x, record_.clipped, frozen_);
  factorised_ = false;
  try {
    linear_.set_matrix(frozen_.matrix);
    solve(frozen_.rhs, frozen_.columns, frozen_direction_);
  } catch (const NumericError&) {
    return false;
  }
  return search(x, frozen_direction_, options_.damping, smallest_step);
}

IterationRecord PointwiseNewton::step(Coordinates& x) {
  ++record_.iteration;
  if (topology_.free_nodes().empty()) return record_;
  // A Newton step that has to be cut this short has left the range of its linear model.
  constexpr double short_step = 0.5;
  constexpr double smallest_step = 1e-3;
  const bool regular = solve_newton(x);
  weigh(x);
  stalled_ = !(regular && search(x, direction_, 1, short_step)) && !search_frozen(x) &&
             !(regular && search(x, direction_, short_step, smallest_step));
  if (stalled_) record_.damping = record_.largest_move = 0;
  assess(x);
  return record_;
}

bool PointwiseNewton::converged() const {
  return record_.residual <= std::max(options_.tolerance, round_off_);
}

void PointwiseNewton::predict(const Coordinates& x, const Coordinates& displacement,
                              std::span<double> out) {
  try {
    if (!factorised_) factorise(x);
    // Both sides belong to the same coordinates: only then does the mesh at a body follow it
    // rigidly, however far it moves.
    std::vector<double> response(out.size());
    formulation_.boundary_response(factorised_at_, factorised_clipped_, displacement, response);
    solve(response, 1, out);
  } catch (const NumericError&) {  // singular: the path turns back here
    factorised_ = false;
    std::fill(out.begin(), out.end(), 0.0);
  }
}

}  // namespace winslow
