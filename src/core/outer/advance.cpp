#include "core/outer/advance.h"

#include <algorithm>
#include <cmath>

#include "core/quality/valid_step.h"

namespace winslow {

double advance(const Topology& topology, std::span<const double> direction, double step,
               Coordinates& x) {
  const auto free = topology.free_nodes();
  double largest2 = 0;
  for (std::size_t i = 0; i < free.size(); ++i) {
    const Vec2 move(step * direction[2 * i], step * direction[2 * i + 1]);
    x.set_xy(free[i], x.xy(free[i]) + move);
    largest2 = std::max(largest2, move.squaredNorm());
  }
  return std::sqrt(largest2);
}

double first_valid_step(const Topology& topology, std::span<const double> direction, double longest,
                        const Coordinates& x, int threads) {
  constexpr double margin = 0.9;
  Coordinates full = x;
  advance(topology, direction, 1, full);
  return std::min(longest, margin * largest_valid_step(topology, x, full, threads));
}

double shorter_step(double t, double slope, double rise) {
  const double shorter = std::isfinite(rise) && rise > 0 ? 0.5 * slope * t * t / rise : 0;
  return std::clamp(shorter, 0.1 * t, 0.5 * t);
}

}  // namespace winslow
