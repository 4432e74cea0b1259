#pragma once

#include "core/mesh/mesh.h"

namespace winslow {

/// Meshes between two of a path along which bodies go, each a rigid one: one for every degree that
/// one of them turns and for every 2 % of its extent that it moves, without both ends. bodies: the
/// nodes of each. These are where the motions take them; each other node goes with the body that
/// takes it farthest on its own way, as far as it does from one end to the other. What would be
/// invalid is left out; empty if nothing moves.
std::vector<Coordinates> meshes_between(const Topology& topology,
                                        std::span<const std::vector<Index>> bodies,
                                        const Coordinates& from, const Coordinates& to);

}  // namespace winslow
