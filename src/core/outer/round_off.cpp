#include "core/outer/round_off.h"

#include <algorithm>
#include <limits>

namespace winslow {

double mean_edge(const Topology& topology, const Coordinates& x, Index node) {
  double sum = 0;
  const auto neighbours = topology.neighbours(node);
  for (const Index k : neighbours) sum += (x.xy(k) - x.xy(node)).norm();
  return sum / static_cast<double>(neighbours.size());
}

double residual_round_off(const Topology& topology, const Coordinates& x) {
  constexpr double safety = 16;
  double worst = 0;
  for (const Index node : topology.free_nodes()) {
    const double edge = mean_edge(topology, x, node);
    if (edge > 0) worst = std::max(worst, x.xy(node).lpNorm<Eigen::Infinity>() / edge);
  }
  // A tangled start can have edges of almost no length; it must not pass for converged.
  return std::min(safety * std::numeric_limits<double>::epsilon() * worst, 1e-7);
}

}  // namespace winslow
