#pragma once

#include "core/motion/motion.h"

/// How bodies get from one position of a series to another:
///
///     const auto way = winslow::ways_between(at_ten_degrees, at_twelve_degrees);
///     if (way && winslow::largest_turn(*way) < 90) ...
namespace winslow {

/// The motions that lead bodies from the ends of the motions `from` to those of the motions `to`,
/// each body along its own arc: halfway it has done half of the difference of its two motions. All
/// motions of `from` and `to` refer to the same mesh and have pivots (with_pivot()); a body that
/// one of them does not name is at rest there. The result refers to the mesh at the end of `from`.
///
/// None if a body has no such arc, so that a mesh which follows it might be wound up otherwise than
/// one that goes along `to` itself: two rotations about different pivots, or about axes that are
/// not parallel unless they are small and near to each other; markers that make up other bodies.
std::optional<std::vector<MovingBody>> ways_between(std::span<const MovingBody> from,
                                                    std::span<const MovingBody> to);

/// No motion, about the same pivot and axis.
RigidMotion at_rest(const RigidMotion& motion);

/// The motions `from`, continued by a share (0 to 1) of ways_between(): motions of the same mesh.
std::vector<MovingBody> part_of_way(std::span<const MovingBody> from,
                                    std::span<const MovingBody> way, double share);

/// Whether the ends of both motions lie on the way of one motion or beyond its ends, as those of a
/// rotation by 4 and by 6 degrees do.
bool on_one_way(std::span<const MovingBody> a, std::span<const MovingBody> b);

/// Upper bound of the length of the longest way of a node along ways_between(), in units of the
/// mesh. from: as there. box_of: the box around a body, by its markers, in the mesh that `from`
/// refers to. Full turns count.
double longest_way(std::span<const MovingBody> way, std::span<const MovingBody> from,
                   const std::function<Box<3>(const MovingBody&)>& box_of);

/// The largest angle by which a body turns, in degrees.
double largest_turn(std::span<const MovingBody> way);

}  // namespace winslow
