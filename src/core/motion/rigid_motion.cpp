#include "core/motion/rigid_motion.h"

#include <cmath>

namespace winslow {

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

RigidMotion inverse(const RigidMotion& motion) {
  return {-motion.rotate, motion.pivot + motion.translate, -motion.translate};
}

RigidMotion fit_rigid_motion(std::span<const Index> nodes, const Coordinates& from,
                             const Coordinates& to) {
  RigidMotion motion;
  if (nodes.empty()) return motion;
  Vec2 centre(0, 0), target(0, 0);
  for (const Index node : nodes) {
    centre += from.xy(node);
    target += to.xy(node);
  }
  centre /= static_cast<double>(nodes.size());
  target /= static_cast<double>(nodes.size());
  // The orthogonal Procrustes problem in the plane.
  double cosine = 0, sine = 0;
  for (const Index node : nodes) {
    const Vec2 a = from.xy(node) - centre, b = to.xy(node) - target;
    cosine += a.dot(b);
    sine += a.x() * b.y() - a.y() * b.x();
  }
  motion.pivot = centre;
  motion.translate = target - centre;
  motion.rotate = degrees(std::atan2(sine, cosine));
  return motion;
}

namespace {

template <int D>
Vec<D> centre_of(const Box<D>& box) {
  Vec<D> centre = box.centre();
  // 6.9e-18 would be the centre of a symmetric body in numbers, but not to a reader.
  const double tiny = 1e-12 * box.size().maxCoeff();
  for (int axis = 0; axis < D; ++axis) {
    if (std::abs(centre[axis]) < tiny) centre[axis] = 0;
  }
  return centre;
}

}  // namespace

Vec2 body_centre(const Bounds& box) { return centre_of(box); }
Vec3 body_centre(const Box<3>& box) { return centre_of(box); }

bool same_motion(const RigidMotion& a, const RigidMotion& b) {
  return a.rotate == b.rotate && a.pivot == b.pivot && a.translate == b.translate;
}

}  // namespace winslow
