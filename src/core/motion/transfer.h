#pragma once

#include "core/mesh/mesh.h"
#include "core/motion/motion.h"
#include "core/problem/node_classes.h"

namespace winslow {

/// The motion that takes the nodes without unknowns from where they are in one set of coordinates
/// to where they are in another: the rigid motion that fits best, followed as such (the shorter way
/// round), and the rest in proportion. Its `rest` argument is `from`; at fraction 1 the nodes are
/// exactly at `to`. In space each node goes in a straight line. For going on from a mesh that a
/// drag has left half-way.
std::unique_ptr<Motion> make_transfer(const NodeClasses& classes, const Coordinates& from,
                                      const Coordinates& to);

/// Meshes between two of a path along which bodies go, each a rigid one: one for every degree that
/// one of them turns and for every 2 % of its extent that it moves, without both ends. bodies: the
/// nodes of each. These are where the motions take them; each other node goes with the body that
/// takes it farthest on its own way, as far as it does from one end to the other. What would be
/// invalid is left out; empty if nothing moves.
std::vector<Coordinates> meshes_between(const Topology& topology,
                                        std::span<const std::vector<Index>> bodies,
                                        const Coordinates& from, const Coordinates& to);

}  // namespace winslow
