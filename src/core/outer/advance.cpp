#include "core/outer/advance.h"

#include <algorithm>
#include <cmath>

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

}  // namespace winslow
