#pragma once

#include <Eigen/Core>
#include <deque>
#include <span>
#include <vector>

namespace winslow {

/// Anderson acceleration of a fixed-point iteration x <- x + f(x): the next iterate is the
/// combination of the last few that would annul the step if f were linear (D. G. Anderson, J. ACM
/// 12, 1965; the type II form of H. Walker and P. Ni, SIAM J. Numer. Anal. 49, 2011).
class AndersonAcceleration {
 public:
  /// depth: how many earlier iterates are combined. weights: one per unknown, what the step is
  /// measured in (here: 1 / local edge length, so that far-field cells do not drown wall cells).
  AndersonAcceleration(int depth, std::vector<double> weights);

  /// Replaces the step f at x by the accelerated one, and remembers both.
  void accelerate(std::span<const double> x, std::span<double> step);
  /// Forgets everything (after the equations changed).
  void reset();

 private:
  std::size_t depth_;
  Eigen::VectorXd weights_;
  Eigen::VectorXd last_x_, last_step_;
  std::deque<Eigen::VectorXd> x_differences_, step_differences_;
};

}  // namespace winslow
