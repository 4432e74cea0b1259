#pragma once

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
/// The same along a motion of bodies from `from`, which has to outlive the result: other nodes
/// without unknowns move in straight lines.
std::unique_ptr<Motion> make_transfer(const NodeClasses& classes, const Coordinates& from,
                                      const Coordinates& to, const Motion& bodies);

/// Combines the nodes with unknowns of one mesh with the other nodes of another mesh.
Coordinates unknowns_within(const NodeClasses& classes, const Coordinates& unknown,
                            Coordinates held);

/// The meshes from which extrapolated() predicts best, at most `most`: those whose `nodes` are
/// nearest to their places in `target`, the nearest first. Left out are meshes in which the nodes
/// are nearly where another one has them. known: all alike.
std::vector<const Coordinates*> nearest_meshes(std::span<const Coordinates* const> known,
                                               std::span<const Index> nodes,
                                               const Coordinates& target, std::size_t most);

/// Predicts a mesh from known ones: the combination a_1 x_1 + ... + a_n x_n, a_1 + ... + a_n = 1,
/// whose `nodes` come nearest to their places in `target` (least squares). Several poses of a body
/// that turns contain all other poses about the same pivot, so that what moves with the body is
/// exact. What the nodes leave open is determined by extrapolation along the way of the nodes. None
/// if the combination misses the target by a tenth of the distance from known.front(), or if it
/// would enlarge errors of the known meshes a hundredfold. known: at least one, all alike.
std::optional<Coordinates> extrapolated(std::span<const Coordinates* const> known,
                                        std::span<const Index> nodes, const Coordinates& target);

/// Interpolates meshes between two meshes of a path of rigid bodies: one for every degree of
/// rotation and every 2 % of a body's extent of translation, without the ends. bodies: the nodes of
/// each. Rigid motions place these nodes. Every other node follows the body whose motion matches
/// its own displacement best, in proportion to that match. Invalid meshes are left out; empty if
/// nothing moves.
std::vector<Coordinates> meshes_between(const Topology& topology,
                                        std::span<const std::vector<Index>> bodies,
                                        const Coordinates& from, const Coordinates& to);

}  // namespace winslow
