#include "core/motion/motion.h"

#include <Eigen/Geometry>

#include "core/error.h"
#include "core/motion/motion_checks.h"

namespace winslow {

namespace {

class Rigid final : public Motion {
 public:
  Rigid(std::vector<Index> nodes, const RigidMotion& options)
      : nodes_(std::move(nodes)), options_(options) {}
  std::span<const Index> nodes() const override { return nodes_; }
  void apply(const Coordinates& rest, double fraction, Coordinates& out) const override {
    const Eigen::Rotation2D<double> rotation(radians(options_.rotate * fraction));
    for (const Index node : nodes_) {
      // A pure translation must not pass through the pivot: that would round.
      const Vec2 turned = options_.rotate == 0
                              ? rest.xy(node)
                              : Vec2(options_.pivot + rotation * (rest.xy(node) - options_.pivot));
      out.set_xy(node, turned + fraction * options_.translate);
    }
  }

 private:
  std::vector<Index> nodes_;
  RigidMotion options_;
};

class RigidInSpace final : public Motion {
 public:
  RigidInSpace(std::vector<Index> nodes, const SpaceMotion& options)
      : nodes_(std::move(nodes)), options_(options), axis_(options.axis.normalized()) {}

  std::span<const Index> nodes() const override { return nodes_; }

  void apply(const Coordinates& rest, double fraction, Coordinates& out) const override {
    const Eigen::Matrix3d rotation =
        Eigen::AngleAxisd(radians(options_.rotate * fraction), axis_).toRotationMatrix();
    for (const Index node : nodes_) {
      const Vec3 p = rest.xyz(node);
      const Vec3 turned =
          options_.rotate == 0 ? p : Vec3(options_.pivot + rotation * (p - options_.pivot));
      out.set_xyz(node, turned + fraction * options_.translate);
    }
  }

 private:
  std::vector<Index> nodes_;
  SpaceMotion options_;
  Vec3 axis_;
};

}  // namespace

void require_fits(const RigidMotionRequest& motion, int dimension) {
  if (dimension == 3)
    static_cast<void>(motion.in_space(Vec3(0, 0, 0)));
  else
    static_cast<void>(motion.about(Vec2(0, 0)));
}

RigidMotion RigidMotionRequest::about(const Vec2& centre) const {
  if (axis || pivot_z || translate_z)
    throw UsageError(
        "an axis or a third component: only for a volume mesh, and this is a plane mesh");
  return {rotate, pivot.value_or(centre), translate};
}

SpaceMotion RigidMotionRequest::in_space(const Vec3& centre) const {
  if (rotate != 0 && !axis) throw UsageError("a rotation in space needs an axis");
  SpaceMotion motion{rotate, axis.value_or(Vec3(0, 0, 1)), centre, {0, 0, 0}};
  if (pivot) motion.pivot << *pivot, pivot_z.value_or(0);
  motion.translate << translate, translate_z.value_or(0);
  return motion;
}

std::unique_ptr<Motion> make_motion(const Topology& topology, const Coordinates&,
                                    const std::vector<std::string>& markers,
                                    const RigidMotion& options) {
  require_finite(options.rotate, "the rotation");
  require_finite(options.pivot.sum(), "the pivot");
  require_finite(options.translate.sum(), "the translation");
  require_plane(topology, "motions of the plane");
  return std::make_unique<Rigid>(moving_nodes(topology, markers), options);
}

std::unique_ptr<Motion> make_motion(const Topology& topology, const Coordinates& rest,
                                    const std::vector<std::string>& markers,
                                    const SpaceMotion& options) {
  require_finite(options.rotate, "the rotation");
  require_finite(options.axis.sum(), "the axis");
  require_finite(options.pivot.sum(), "the pivot");
  require_finite(options.translate.sum(), "the translation");
  if (options.axis.norm() == 0) throw UsageError("the axis of the rotation has no length");
  rest.require_dimension(3);
  return std::make_unique<RigidInSpace>(moving_nodes(topology, markers), options);
}

}  // namespace winslow
