#include "core/vcv/vcv_checks.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/error.h"

namespace winslow {

void require_vcv_node(const Topology& topology, Index node) {
  if (node < 0 || node >= topology.node_count() || topology.on_boundary(node) ||
      !topology.used(node)) {
    throw UsageError("VCV of node " + std::to_string(node) +
                     ": the node is not a free node of the mesh");
  }
}

void require_edge_lengths(Index node, std::span<const double> lengths) {
  const std::string who = "VCV of node " + std::to_string(node);
  for (const double length : lengths) {
    if (!(length > 0) || !std::isfinite(length)) {
      throw UsageError(who + ": an edge length is not positive");
    }
  }
  // Beyond this the short edges are lost in the rounding of the long ones.
  constexpr double most_stretched = 1e12;
  const auto [shortest, longest] = std::ranges::minmax(lengths);
  if (longest > most_stretched * shortest) {
    throw UsageError(who + ": the longest edge is more than 1e12 times the shortest");
  }
}

}  // namespace winslow
