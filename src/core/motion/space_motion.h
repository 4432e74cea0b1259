#pragma once

#include <span>
#include <type_traits>

#include "core/mesh/coordinates.h"
#include "core/motion/rigid_motion.h"

/// The algebra of rigid motions in space, as rigid_motion.h has it for the plane.
namespace winslow {

template <int D>
using RigidMotionIn = std::conditional_t<D == 2, RigidMotion, SpaceMotion>;

/// Counter-clockwise about the axis, as seen from where it points to.
Vec3 rotated(const SpaceMotion& motion, const Vec3& vector);

Vec3 transform(const SpaceMotion& motion, const Vec3& point);
Vec3 transform_back(const SpaceMotion& motion, const Vec3& point);
/// The motion that is `first`, then `second`. Rotations about parallel axes keep their full turns;
/// of others the shorter way round is taken, by 180 degrees at most.
SpaceMotion compose(const SpaceMotion& first, const SpaceMotion& second);
SpaceMotion inverse(const SpaceMotion& motion);
/// The motion that brings `nodes` of `from` nearest to where they are in `to` (least squares, W.
/// Kabsch, Acta Cryst. A32, 1976); rotation in [0, 180].
SpaceMotion fit_space_motion(std::span<const Index> nodes, const Coordinates& from,
                             const Coordinates& to);
/// A fitted motion about the axis of another, if its own is parallel, with as many full turns as
/// bring it nearest to `degrees`.
SpaceMotion with_turns(SpaceMotion fitted, const Vec3& axis, double degrees);
RigidMotion with_turns(RigidMotion fitted, double degrees);
bool same_motion(const SpaceMotion& a, const SpaceMotion& b);

}  // namespace winslow
