#pragma once

#include "core/motion/motion.h"

namespace winslow::gui {

/// Where a rigid motion takes a point.
Vec2 transform(const RigidMotion& motion, const Vec2& point);
/// Where a point was before a rigid motion.
Vec2 transform_back(const RigidMotion& motion, const Vec2& point);
/// The rigid motion that is `first`, then `second`. A translation alone keeps rotate exactly 0.
RigidMotion compose(const RigidMotion& first, const RigidMotion& second);
bool same_motion(const RigidMotion& a, const RigidMotion& b);

}  // namespace winslow::gui
