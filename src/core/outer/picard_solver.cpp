#include "core/outer/picard_solver.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace winslow {

PicardSolver::PicardSolver(const Topology& topology, const Formulation& formulation,
                           LinearSolver& linear, const SmoothOptions& options)
    : topology_(topology), formulation_(formulation), linear_(linear), options_(options) {}

bool PicardSolver::choose_clip(Index inverted) {
  if (options_.clip != Clip::automatic) return options_.clip == Clip::on;
  if (inverted > 0 && unclipped_before_) ++relapses_;
  // A mesh whose unclipped solution is tangled would otherwise switch to and fro for ever.
  constexpr int patience = 3;
  const bool clip = inverted > 0 || relapses_ >= patience;
  unclipped_before_ = !clip;
  return clip;
}

void PicardSolver::assess(const Coordinates& x) {
  const Validity validity = check_validity(topology_, x, options_.threads);
  record_.inverted = validity.inverted;
  record_.min_sine = validity.min_sine;
  record_.clipped = choose_clip(validity.inverted);
  record_.residual = formulation_.residual(x, record_.clipped, {}).max;
  if (!std::isfinite(record_.residual)) {
    throw NumericError("the coordinates are no longer finite; try a smaller damping");
  }
}

IterationRecord PicardSolver::start(const Coordinates& x) {
  const double fraction = record_.fraction;
  record_ = {};
  record_.fraction = fraction;
  record_.damping = options_.damping;
  unclipped_before_ = false;
  relapses_ = 0;
  assess(x);
  return record_;
}

double PicardSolver::apply_step(Coordinates& x) const {
  const auto free = topology_.free_nodes();
  double largest2 = 0;
  for (std::size_t i = 0; i < free.size(); ++i) {
    const Vec2 move = options_.damping * Vec2(delta_[2 * i], delta_[2 * i + 1]);
    x.set_xy(free[i], x.xy(free[i]) + move);
    largest2 = std::max(largest2, move.squaredNorm());
  }
  return std::sqrt(largest2);
}

IterationRecord PicardSolver::step(Coordinates& x) {
  formulation_.freeze(x, record_.clipped, system_);
  delta_.assign(system_.rhs.size(), 0.0);
  record_.linear_iterations = linear_.solve(system_, delta_).iterations;
  record_.largest_move = apply_step(x);
  ++record_.iteration;
  assess(x);
  return record_;
}

bool PicardSolver::converged() const { return record_.residual <= options_.tolerance; }

}  // namespace winslow
