#pragma once

#include "core/mesh/mesh.h"
#include "core/motion/motion.h"
#include "core/problem/node_classes.h"

namespace winslow {

/// The motion of the nodes without unknowns from their positions in `from` to those in `to`, for
/// continuing from a mesh that a drag left half-way. In the plane it interpolates the best-fit
/// rigid motion (by the shorter rotation) and adds the remainder in proportion. In space each node
/// moves in a straight line. Its `rest` argument is `from`; at fraction 1 the nodes are exactly at
/// `to`.
std::unique_ptr<Motion> make_transfer(const NodeClasses& classes, const Coordinates& from,
                                      const Coordinates& to);

/// Interpolates meshes between two meshes of a path of rigid bodies: one for every degree of
/// rotation and every 2 % of a body's extent of translation, without the ends. bodies: the nodes of
/// each. Rigid motions place these nodes. Every other node follows the body whose motion matches
/// its own displacement best, in proportion to that match. Invalid meshes are left out; empty if
/// nothing moves.
std::vector<Coordinates> meshes_between(const Topology& topology,
                                        std::span<const std::vector<Index>> bodies,
                                        const Coordinates& from, const Coordinates& to);

}  // namespace winslow
