#pragma once

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

}  // namespace winslow
