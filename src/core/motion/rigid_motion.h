#pragma once

#include <span>
#include <type_traits>

#include "core/mesh/coordinates.h"
#include "core/mesh/mesh.h"
#include "core/motion/motion.h"

namespace winslow {

/// Where a rigid motion takes a point.
Vec2 transform(const RigidMotion& motion, const Vec2& point);
/// Where a point was before a rigid motion.
Vec2 transform_back(const RigidMotion& motion, const Vec2& point);
/// The rigid motion that is `first`, then `second`. A translation alone keeps rotate exactly 0.
RigidMotion compose(const RigidMotion& first, const RigidMotion& second);
/// The motion that takes everything back.
RigidMotion inverse(const RigidMotion& motion);
/// The rigid motion that brings `nodes` of `from` nearest to where they are in `to` (least squares;
/// rotation in (-180, 180]). Translation by zero for no nodes.
RigidMotion fit_rigid_motion(std::span<const Index> nodes, const Coordinates& from,
                             const Coordinates& to);
/// The point about which bodies turn unless another is named: the centre of the bounding box of
/// all that moves. A component that is nothing but rounding errors is 0.
Vec2 body_centre(const Bounds& box);
Vec3 body_centre(const Box<3>& box);
bool same_motion(const RigidMotion& a, const RigidMotion& b);

/// The algebra of rigid motions in space, as rigid_motion.h has it for the plane.

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
