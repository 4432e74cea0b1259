#pragma once

#include <span>
#include <vector>

#include "core/mesh/mesh.h"

namespace winslow {

/// Meshes between two of a path along which `moved` nodes go as a rigid body: one for every degree
/// that they turn and for every 2 % of their extent that they move, without both ends. The moved
/// nodes are where the motion takes them; the others go with it as far as they do from one end to
/// the other. What would be invalid is left out; empty if the nodes do not move.
std::vector<Coordinates> meshes_between(const Topology& topology, std::span<const Index> moved,
                                        const Coordinates& from, const Coordinates& to);

}  // namespace winslow
