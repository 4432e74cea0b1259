#include "gui/studio/rigid_motion.h"

#include <cmath>

namespace winslow::gui {

namespace {

Vec2 rotated(const Vec2& v, double degrees) {
  if (degrees == 0) return v;
  const double c = std::cos(radians(degrees));
  const double s = std::sin(radians(degrees));
  return {c * v.x() - s * v.y(), s * v.x() + c * v.y()};
}

}  // namespace

Vec2 transform(const RigidMotion& motion, const Vec2& point) {
  return motion.pivot + rotated(point - motion.pivot, motion.rotate) + motion.translate;
}

Vec2 transform_back(const RigidMotion& motion, const Vec2& point) {
  return motion.pivot + rotated(point - motion.translate - motion.pivot, -motion.rotate);
}

RigidMotion compose(const RigidMotion& first, const RigidMotion& second) {
  RigidMotion total;
  total.rotate = first.rotate + second.rotate;
  if (second.rotate == 0) {
    total.pivot = first.pivot;
    total.translate = first.translate + second.translate;
    return total;
  }
  total.pivot = transform_back(first, second.pivot);
  total.translate = second.pivot - total.pivot + second.translate;
  return total;
}

bool same_motion(const RigidMotion& a, const RigidMotion& b) {
  return a.rotate == b.rotate && a.pivot == b.pivot && a.translate == b.translate;
}

}  // namespace winslow::gui
