#pragma once

#include <span>

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

}  // namespace winslow
