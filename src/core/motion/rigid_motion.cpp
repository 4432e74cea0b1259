#include "core/motion/rigid_motion.h"

#include <Eigen/Geometry>
#include <Eigen/SVD>
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

namespace {

Eigen::Quaterniond rotation_of(const SpaceMotion& motion) {
  return Eigen::Quaterniond(Eigen::AngleAxisd(radians(motion.rotate), motion.axis.normalized()));
}

bool are_parallel(const Vec3& a, const Vec3& b) {
  constexpr double round_off = 1e-12;
  return a.normalized().cross(b.normalized()).norm() < round_off;
}

/// Sets rotation and axis.
void set_rotation(SpaceMotion& motion, const Eigen::Quaterniond& rotation) {
  const Eigen::AngleAxisd turn(rotation);
  motion.rotate = degrees(turn.angle());
  if (motion.rotate > 180) motion.rotate -= 360;
  motion.axis = turn.axis();
}

}  // namespace

Vec3 rotated(const SpaceMotion& motion, const Vec3& vector) {
  return motion.rotate == 0 ? vector : Vec3(rotation_of(motion) * vector);
}

Vec3 transform(const SpaceMotion& motion, const Vec3& point) {
  // A pure translation must not pass through the pivot: that would round.
  if (motion.rotate == 0) return point + motion.translate;
  return motion.pivot + rotated(motion, point - motion.pivot) + motion.translate;
}

Vec3 transform_back(const SpaceMotion& motion, const Vec3& point) {
  if (motion.rotate == 0) return point - motion.translate;
  SpaceMotion back = motion;
  back.rotate = -motion.rotate;
  return motion.pivot + rotated(back, point - motion.translate - motion.pivot);
}

SpaceMotion compose(const SpaceMotion& first, const SpaceMotion& second) {
  if (second.rotate == 0) {
    SpaceMotion total = first;
    total.translate += second.translate;
    return total;
  }
  SpaceMotion total = second;
  if (first.rotate != 0 && are_parallel(first.axis, second.axis)) {
    total.axis = first.axis;
    total.rotate = first.rotate + (first.axis.dot(second.axis) < 0 ? -1 : 1) * second.rotate;
  } else if (first.rotate != 0) {
    set_rotation(total, rotation_of(second) * rotation_of(first));
  }
  total.pivot = transform_back(first, second.pivot);
  total.translate = second.pivot - total.pivot + second.translate;
  return total;
}

SpaceMotion inverse(const SpaceMotion& motion) {
  return {-motion.rotate, motion.axis, motion.pivot + motion.translate, -motion.translate};
}

SpaceMotion fit_space_motion(std::span<const Index> nodes, const Coordinates& from,
                             const Coordinates& to) {
  SpaceMotion motion;
  if (nodes.empty()) return motion;
  const SpacePoints before(from), after(to);
  Vec3 centre = Vec3::Zero(), target = Vec3::Zero();
  for (const Index node : nodes) {
    centre += before[node];
    target += after[node];
  }
  centre /= static_cast<double>(nodes.size());
  target /= static_cast<double>(nodes.size());
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (const Index node : nodes)
    covariance += (after[node] - target) * (before[node] - centre).transpose();
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(covariance,
                                              Eigen::ComputeFullU | Eigen::ComputeFullV);
  // A rotation, no reflection.
  const double sign = (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0 ? -1 : 1;
  const Eigen::Matrix3d rotation =
      svd.matrixU() * Vec3(1, 1, sign).asDiagonal() * svd.matrixV().transpose();
  set_rotation(motion, Eigen::Quaterniond(rotation));
  motion.pivot = centre;
  motion.translate = target - centre;
  return motion;
}

RigidMotion with_turns(RigidMotion fitted, double degrees) {
  fitted.rotate += 360 * std::round((degrees - fitted.rotate) / 360);
  return fitted;
}

SpaceMotion with_turns(SpaceMotion fitted, const Vec3& axis, double degrees) {
  constexpr double nearly = 1e-6;
  const Vec3 wanted = axis.normalized(), own = fitted.axis.normalized();
  const bool parallel = own.cross(wanted).norm() < nearly;
  // The axis of a rotation by nothing is anything.
  if (!parallel && std::abs(fitted.rotate) > nearly) return fitted;
  if (own.dot(wanted) < 0) fitted.rotate = -fitted.rotate;
  fitted.axis = axis;
  fitted.rotate += 360 * std::round((degrees - fitted.rotate) / 360);
  return fitted;
}

bool same_motion(const SpaceMotion& a, const SpaceMotion& b) {
  return a.rotate == b.rotate && (a.rotate == 0 || a.axis == b.axis) && a.pivot == b.pivot &&
         a.translate == b.translate;
}

}  // namespace winslow
