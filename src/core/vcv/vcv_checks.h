#pragma once

#include <span>

#include "core/mesh/topology.h"

namespace winslow {

/// What the VCVs of plane and of volume meshes ask of a node and of the edge lengths that it is
/// given.

/// Throws UsageError unless it is an interior node that some element uses.
void require_vcv_node(const Topology& topology, Index node);

/// Throws UsageError, naming the node, unless the lengths are positive and the longest is at most
/// 1e12 times the shortest.
void require_edge_lengths(Index node, std::span<const double> lengths);

}  // namespace winslow
