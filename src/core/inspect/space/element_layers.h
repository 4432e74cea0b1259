#pragma once

#include <span>
#include <vector>

#include "core/mesh/topology.h"

namespace winslow {

/// How many elements deep each element lies below some nodes (#elements): 1 for elements that have
/// one of the nodes, 2 for those beside them (with a node in common), and so on; 0 where none of
/// the nodes can be reached.
std::vector<Index> element_layers(const Topology& topology, std::span<const Index> nodes);

}  // namespace winslow
