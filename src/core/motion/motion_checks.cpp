#include "core/motion/motion_checks.h"

#include <cmath>

#include "core/error.h"

namespace winslow {

std::vector<Index> moving_nodes(const Topology& topology, const std::vector<std::string>& markers) {
  if (markers.empty()) throw UsageError("no marker given: which boundary is to move?");
  std::vector<Index> nodes = topology.markers().nodes_of(markers);
  if (nodes.empty()) throw UsageError("the chosen markers have no nodes");
  return nodes;
}

void require_finite(double value, const char* what) {
  if (!std::isfinite(value)) throw UsageError(std::string(what) + " is not a finite number");
}

}  // namespace winslow
