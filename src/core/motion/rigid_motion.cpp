#include "core/motion/rigid_motion.h"

#include <Eigen/Geometry>
#include <Eigen/SVD>

#include "core/error.h"
#include "core/motion/motion.h"

namespace winslow {

namespace {

Eigen::Quaterniond rotation_of(const RigidMotion& motion) {
  return Eigen::Quaterniond(
      Eigen::AngleAxisd(radians(motion.rotate), axis_of(motion).normalized()));
}

bool are_parallel(const Vec3& a, const Vec3& b) {
  constexpr double round_off = 1e-12;
  return a.normalized().cross(b.normalized()).norm() < round_off;
}

/// Sets rotation and axis.
void set_rotation(RigidMotion& motion, const Eigen::Quaterniond& rotation) {
  const Eigen::AngleAxisd turn(rotation);
  motion.rotate = degrees(turn.angle());
  if (motion.rotate > 180) motion.rotate -= 360;
  motion.axis = turn.axis();
}

/// A translation of space must not use the pivot, which would cause rounding. A translation of the
/// plane does use it, like rotations: this keeps the bits of results of plane meshes.
bool only_shifts(const RigidMotion& motion) { return motion.rotate == 0 && motion.axis; }

/// The mean positions of nodes before and after.
template <int D>
struct Centres {
  Vec<D> before = Vec<D>::Zero(), after = Vec<D>::Zero();
};

template <int D>
Centres<D> centres_of(std::span<const Index> nodes, const Points<D>& from, const Points<D>& to) {
  Centres<D> centres;
  for (const Index node : nodes) {
    centres.before += from[node];
    centres.after += to[node];
  }
  centres.before /= static_cast<double>(nodes.size());
  centres.after /= static_cast<double>(nodes.size());
  return centres;
}

/// The orthogonal Procrustes problem in the plane.
RigidMotion fit(std::span<const Index> nodes, const PlanePoints& from, const PlanePoints& to) {
  if (nodes.empty()) return {};
  const Centres<2> centres = centres_of<2>(nodes, from, to);
  double cosine = 0, sine = 0;
  for (const Index node : nodes) {
    const Vec2 a = from[node] - centres.before, b = to[node] - centres.after;
    cosine += a.dot(b);
    sine += a.x() * b.y() - a.y() * b.x();
  }
  return {.rotate = degrees(std::atan2(sine, cosine)),
          .pivot = centres.before,
          .translate = Vec2(centres.after - centres.before)};
}

RigidMotion fit(std::span<const Index> nodes, const SpacePoints& from, const SpacePoints& to) {
  if (nodes.empty()) return {.axis = Vec3::UnitZ()};
  const Centres<3> centres = centres_of<3>(nodes, from, to);
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (const Index node : nodes)
    covariance += (to[node] - centres.after) * (from[node] - centres.before).transpose();
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(covariance,
                                              Eigen::ComputeFullU | Eigen::ComputeFullV);
  // Enforces a rotation, not a reflection.
  const double sign = (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0 ? -1 : 1;
  const Eigen::Matrix3d rotation =
      svd.matrixU() * Vec3(1, 1, sign).asDiagonal() * svd.matrixV().transpose();
  RigidMotion motion{.pivot = centres.before, .translate = Vec3(centres.after - centres.before)};
  set_rotation(motion, Eigen::Quaterniond(rotation));
  return motion;
}

void require_in_plane(const RigidMotion& motion) {
  if (motion.axis || motion.translate.leaves_plane() ||
      (motion.pivot && motion.pivot->leaves_plane()))
    throw UsageError(
        "an axis or a third component: only for a volume mesh, and this is a plane mesh");
}

}  // namespace

RigidMotion resolve_motion(RigidMotion motion, int dimension, const Vec3& centre) {
  if (dimension == 3) {
    if (motion.rotate != 0 && !motion.axis) throw UsageError("a rotation in space needs an axis");
    motion.axis = axis_of(motion);
  } else {
    require_in_plane(motion);
  }
  motion.pivot = motion.pivot ? Vec3(*motion.pivot) : centre;
  motion.translate = Vec3(motion.translate);
  require_finite(motion.rotate, "the rotation");
  require_finite(axis_of(motion).sum(), "the axis");
  require_finite(motion.pivot->sum(), "the pivot");
  require_finite(motion.translate.sum(), "the translation");
  if (axis_of(motion).norm() == 0) throw UsageError("the axis of the rotation has no length");
  return motion;
}

Vec3 pivot_of(const RigidMotion& motion) { return motion.pivot.value_or(Vec3(0, 0, 0)); }
Vec3 axis_of(const RigidMotion& motion) { return motion.axis.value_or(Vec3::UnitZ()); }
bool moves(const RigidMotion& motion) {
  return motion.rotate != 0 || motion.translate != Vec3(0, 0, 0);
}

Vec3 rotated(const RigidMotion& motion, const Vec3& vector) {
  if (motion.rotate == 0) return vector;
  if (motion.axis) return rotation_of(motion) * vector;
  const double c = std::cos(radians(motion.rotate));
  const double s = std::sin(radians(motion.rotate));
  return {c * vector.x() - s * vector.y(), s * vector.x() + c * vector.y(), vector.z()};
}

Vec3 transform(const RigidMotion& motion, const Vec3& point) {
  if (only_shifts(motion)) return point + motion.translate;
  const Vec3 pivot = pivot_of(motion);
  return pivot + rotated(motion, point - pivot) + motion.translate;
}

Vec3 transform_back(const RigidMotion& motion, const Vec3& point) {
  if (only_shifts(motion)) return point - motion.translate;
  RigidMotion back = motion;
  back.rotate = -motion.rotate;
  const Vec3 pivot = pivot_of(motion);
  return pivot + rotated(back, point - motion.translate - pivot);
}

Vec2 transform(const RigidMotion& motion, const Vec2& point) {
  return transform(motion, Vec3(point.x(), point.y(), 0)).head<2>();
}

Vec2 transform_back(const RigidMotion& motion, const Vec2& point) {
  return transform_back(motion, Vec3(point.x(), point.y(), 0)).head<2>();
}

RigidMotion compose(const RigidMotion& first, const RigidMotion& second) {
  if (second.rotate == 0) {
    RigidMotion total = first;
    total.translate = first.translate + second.translate;
    return total;
  }
  RigidMotion total = second;
  if (first.rotate != 0 && are_parallel(axis_of(first), axis_of(second))) {
    total.axis = first.axis;
    const bool against = axis_of(first).dot(axis_of(second)) < 0;
    total.rotate = first.rotate + (against ? -1 : 1) * second.rotate;
  } else if (first.rotate != 0) {
    set_rotation(total, rotation_of(second) * rotation_of(first));
  }
  const Vec3 about = pivot_of(second), pivot = transform_back(first, about);
  total.pivot = pivot;
  total.translate = about - pivot + second.translate;
  return total;
}

RigidMotion inverse(const RigidMotion& motion) {
  return {.rotate = -motion.rotate,
          .pivot = Vec3(pivot_of(motion) + motion.translate),
          .translate = Vec3(-motion.translate),
          .axis = motion.axis};
}

RigidMotion fit_rigid_motion(std::span<const Index> nodes, const Coordinates& from,
                             const Coordinates& to) {
  return in_dimension(
      from, [&]<int D>(const Points<D>& before) { return fit(nodes, before, Points<D>(to)); });
}

RigidMotion with_turns(RigidMotion fitted, const RigidMotion& other, double degrees) {
  if (fitted.axis) {
    constexpr double nearly = 1e-6;
    const Vec3 wanted = axis_of(other).normalized(), own = fitted.axis->normalized();
    const bool parallel = own.cross(wanted).norm() < nearly;
    // A rotation by zero has no defined axis.
    if (!parallel && std::abs(fitted.rotate) > nearly) return fitted;
    if (own.dot(wanted) < 0) fitted.rotate = -fitted.rotate;
    fitted.axis = axis_of(other);
  }
  fitted.rotate += 360 * std::round((degrees - fitted.rotate) / 360);
  return fitted;
}

bool same_motion(const RigidMotion& a, const RigidMotion& b) {
  return a.rotate == b.rotate && (a.rotate == 0 || axis_of(a) == axis_of(b)) &&
         pivot_of(a) == pivot_of(b) && a.translate == b.translate;
}

Vec3 body_centre(const Box<3>& box) {
  Vec3 centre = box.centre();
  // The computed centre of a symmetric body can be 6.9e-18; users expect 0.
  const double tiny = 1e-12 * box.size().maxCoeff();
  for (double& component : centre)
    if (std::abs(component) < tiny) component = 0;
  return centre;
}

Box<3> body_box(const Coordinates& x, std::span<const Index> nodes) {
  if (nodes.empty()) throw UsageError("bounds of no nodes");
  Box<3> box = Box<3>::empty();
  for (const Index node : nodes) box.add(place_of(x, node));
  return box;
}

}  // namespace winslow
