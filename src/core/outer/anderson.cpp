#include "core/outer/anderson.h"

#include <Eigen/QR>

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

}  // namespace winslow
