#pragma once

#include <string>
#include <vector>

#include "core/mesh/topology.h"

namespace winslow {

/// The nodes of the markers that are to move, ascending. Throws UsageError if there is no marker,
/// an unknown one, or no node.
std::vector<Index> moving_nodes(const Topology& topology, const std::vector<std::string>& markers);
/// Throws UsageError unless the number is finite. what: "the amplitude", as the message is to
/// begin.
void require_finite(double value, const char* what);

}  // namespace winslow
