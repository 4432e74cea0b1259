#include "core/formulation/free_nodes.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/quality/quality.h"
#include "core/quality/valid_step.h"

namespace winslow {

double FreeNodes::mean_edge(const Coordinates& x, Index node) const {
  double sum = 0;
  const auto neighbours = topology_->neighbours(node);
  for (const Index k : neighbours) sum += (x.xy(k) - x.xy(node)).norm();
  return sum / static_cast<double>(neighbours.size());
}

void FreeNodes::values(const Coordinates& x, std::span<double> out) const {
  std::size_t next = 0;
  for (const Index node : nodes()) {
    const Vec2 p = x.xy(node);
    out[next++] = p.x();
    out[next++] = p.y();
  }
}

void FreeNodes::lengths(const Coordinates& x, std::span<double> out) const {
  std::size_t next = 0;
  for (const Index node : nodes()) {
    out[next] = out[next + 1] = mean_edge(x, node);
    next += per_node;
  }
}

double FreeNodes::advance(std::span<const double> direction, double step, Coordinates& x) const {
  const auto free = nodes();
  double largest2 = 0;
  for (std::size_t i = 0; i < free.size(); ++i) {
    const Vec2 move(step * direction[2 * i], step * direction[2 * i + 1]);
    x.set_xy(free[i], x.xy(free[i]) + move);
    largest2 = std::max(largest2, move.squaredNorm());
  }
  return std::sqrt(largest2);
}

void FreeNodes::velocities(std::span<const double> rates, Coordinates& out) const {
  const auto free = nodes();
  for (std::size_t i = 0; i < free.size(); ++i) {
    out.set_xy(free[i], Vec2(rates[2 * i], rates[2 * i + 1]));
  }
}

double FreeNodes::largest_valid_step(const Coordinates& from, const Coordinates& to) const {
  return winslow::largest_valid_step(*topology_, from, to, threads_);
}

Validity FreeNodes::validity(const Coordinates& x) const {
  return check_validity(*topology_, x, threads_);
}

double FreeNodes::residual_round_off(const Coordinates& x) const {
  constexpr double safety = 16;
  double worst = 0;
  for (const Index node : nodes()) {
    const double edge = mean_edge(x, node);
    if (edge > 0) worst = std::max(worst, x.xy(node).lpNorm<Eigen::Infinity>() / edge);
  }
  // A tangled start can have edges of almost no length; it must not pass for converged.
  return std::min(safety * std::numeric_limits<double>::epsilon() * worst, 1e-7);
}

}  // namespace winslow
