#include "core/outer/picard_solver.h"

#include <Eigen/QR>
#include <cmath>

#include "core/error.h"

namespace winslow {

AndersonAcceleration::AndersonAcceleration(int depth, std::vector<double> weights)
    : depth_(static_cast<std::size_t>(depth)),
      weights_(Eigen::Map<const Eigen::VectorXd>(weights.data(),
                                                 static_cast<Eigen::Index>(weights.size()))) {}

void AndersonAcceleration::reset() {
  last_x_.resize(0);
  x_differences_.clear();
  step_differences_.clear();
}

void AndersonAcceleration::accelerate(std::span<const double> x, std::span<double> step) {
  const auto n = static_cast<Eigen::Index>(x.size());
  const Eigen::VectorXd here = Eigen::Map<const Eigen::VectorXd>(x.data(), n);
  Eigen::Map<Eigen::VectorXd> out(step.data(), n);
  const Eigen::VectorXd plain = out;
  if (last_x_.size() == n) {
    x_differences_.push_back(here - last_x_);
    step_differences_.push_back(plain - last_step_);
    if (x_differences_.size() > depth_) {
      x_differences_.pop_front();
      step_differences_.pop_front();
    }
    const auto m = static_cast<Eigen::Index>(x_differences_.size());
    Eigen::MatrixXd weighted(n, m);
    for (Eigen::Index k = 0; k < m; ++k) {
      weighted.col(k) = weights_.cwiseProduct(step_differences_[static_cast<std::size_t>(k)]);
    }
    const Eigen::VectorXd gamma =
        weighted.colPivHouseholderQr().solve(weights_.cwiseProduct(plain).eval());
    if (gamma.allFinite()) {
      for (Eigen::Index k = 0; k < m; ++k) {
        const auto i = static_cast<std::size_t>(k);
        out -= gamma[k] * (x_differences_[i] + step_differences_[i]);
      }
    }
  }
  last_x_ = here;
  last_step_ = plain;
}

namespace {

/// Weights for the norm of a step, so that far-field cells do not dominate wall cells.
std::vector<double> inverse_lengths(const SmoothingProblem& problem, const Coordinates& x) {
  std::vector<double> weights(problem.unknowns());
  problem.lengths(x, weights);
  for (double& weight : weights) weight = 1 / weight;
  return weights;
}

/// If the unclipped solution tangles the mesh, clipping would otherwise alternate forever: after
/// this many relapses it stays on.
constexpr int most_relapses = 3;

}  // namespace

PicardSolver::PicardSolver(ClipVariants<FixedPointProblem> problems, LinearSolver& linear,
                           const EquationOptions& options)
    : problems_(std::move(problems)), linear_(linear), options_(options) {}

bool PicardSolver::choose_clip(Index inverted) {
  if (options_.clip != Clip::automatic) return options_.clip == Clip::on;
  if (inverted > 0 && unclipped_before_) ++relapses_;
  const bool clip = inverted > 0 || relapses_ >= most_relapses;
  unclipped_before_ = !clip;
  return clip;
}

void PicardSolver::assess(const Coordinates& x) {
  const bool clipped_before = record_.clipped;
  const Validity validity = problem().validity(x);
  record(validity);
  record_.clipped = choose_clip(validity.inverted);
  if (record_.clipped != clipped_before) acceleration_.reset();
  record_.residual = problem().residual(x, {}).max;
  if (!std::isfinite(record_.residual)) {
    throw NumericError("the coordinates are no longer finite; try a smaller damping");
  }
  if (record_.inverted == 0) round_off_ = problem().residual_round_off(x);
}

IterationRecord PicardSolver::start(const Coordinates& x) {
  begin_record(options_.damping);
  unclipped_before_ = false;
  relapses_ = 0;
  round_off_ = 0;
  acceleration_.reset();
  assess(x);
  best_residual_ = record_.residual;
  least_inverted_ = record_.inverted;
  last_progress_ = 0;
  return record_;
}

void PicardSolver::adapt_damping() {
  constexpr double progress = 0.9;
  constexpr int patience = 40;
  constexpr double smallest = 0.02;
  if (record_.residual < progress * best_residual_ || record_.inverted < least_inverted_) {
    best_residual_ = std::min(best_residual_, record_.residual);
    least_inverted_ = std::min(least_inverted_, record_.inverted);
    last_progress_ = record_.iteration;
  } else if (record_.iteration - last_progress_ >= patience) {
    const bool clip_could_help = options_.clip == Clip::automatic && !record_.clipped;
    if (clip_could_help) {
      relapses_ = most_relapses;
    } else if (options_.adapt_damping) {
      record_.damping = std::max(smallest, 0.5 * record_.damping);
    }
    best_residual_ = record_.residual;
    least_inverted_ = record_.inverted;
    last_progress_ = record_.iteration;
    acceleration_.reset();
  }
}

bool PicardSolver::accelerate(const Coordinates& x, std::vector<double>& step) {
  if (options_.acceleration <= 0 || record_.inverted > 0) return false;
  constexpr double distrust = 5;
  if (acceleration_ && record_.residual > distrust * best_accelerated_) acceleration_.reset();
  if (!acceleration_) {
    acceleration_.emplace(options_.acceleration, inverse_lengths(problem(), x));
    best_accelerated_ = record_.residual;
  }
  best_accelerated_ = std::min(best_accelerated_, record_.residual);
  std::vector<double> here(step.size());
  problem().values(x, here);
  acceleration_->accelerate(here, step);
  return true;
}

IterationRecord PicardSolver::step(Coordinates& x) {
  if (problem().unknowns() == 0) {
    ++record_.iteration;
    return record_;
  }
  problem().freeze(x, system_);
  std::vector<double> plain(system_.rhs.size(), 0.0);
  linear_.set_matrix(system_.matrix);
  record_.linear_iterations = linear_.solve(system_.rhs, system_.columns, plain).iterations;
  ++linear_solves_;
  for (double& s : plain) s *= record_.damping;

  const bool was_valid = record_.inverted == 0;
  std::vector<double> step = plain;
  const bool accelerated = accelerate(x, step);
  Coordinates trial = x;
  record_.largest_move = problem().advance(step, 1, trial);
  if (was_valid && accelerated && problem().validity(trial).inverted > 0) {
    acceleration_.reset();
    trial = x;
    record_.largest_move = problem().advance(plain, 1, trial);
  }
  x = std::move(trial);
  ++record_.iteration;
  assess(x);
  adapt_damping();
  return record_;
}

bool PicardSolver::converged() const {
  return record_.residual <= std::max(options_.tolerance, round_off_);
}

}  // namespace winslow
