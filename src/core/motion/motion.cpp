#include "core/motion/motion.h"

#include <Eigen/Geometry>
#include <cmath>

#include "core/error.h"

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

std::vector<Index> moving_nodes(const Topology& topology, const std::vector<std::string>& markers) {
  if (markers.empty()) throw UsageError("no marker given: which boundary is to move?");
  std::vector<Index> nodes = topology.markers().nodes_of(markers);
  if (nodes.empty()) throw UsageError("the chosen markers have no nodes");
  return nodes;
}

void require_finite(double value, const char* what) {
  if (!std::isfinite(value)) throw UsageError(std::string(what) + " is not a finite number");
}

OptionTable option_table(RigidMotionRequest& motion) {
  return {
      {.key = "rotate",
       .value = RealOption{&motion.rotate},
       .label = "Rotate",
       .help = "Angle about the pivot, counter-clockwise positive; in space about the axis",
       .unit = "degrees"},
      {.key = "axis",
       .value = SpaceVectorOption{&motion.axis},
       .label = "Axis",
       .help = "Direction of the axis through the pivot, for volume meshes: the rotation is "
               "counter-clockwise seen from where it points to",
       .applies = motion.axis.has_value()},
      {.key = "pivot",
       .value = OptionalVectorOption{&motion.pivot, &motion.pivot_z},
       .label = "Pivot",
       .help = "Point about which it turns; not given: the centre of the bounding box of all that "
               "moves",
       .unit = "units of the mesh",
       .applies = motion.pivot.has_value()},
      {.key = "translate",
       .value = VectorOption{&motion.translate, &motion.translate_z},
       .label = "Translate",
       .help = "Shift, after the rotation",
       .unit = "units of the mesh"},
  };
}

OptionTable option_table(SineDeformation& sine) {
  return {
      {.key = "amplitude",
       .value = RealOption{&sine.amplitude},
       .label = "Amplitude",
       .help = "Largest displacement",
       .unit = "units of the mesh",
       .required = true,
       .on_command_line = OnCommandLine::no},
      {.key = "waves",
       .value = RealOption{&sine.waves},
       .label = "Waves",
       .help = "Full periods over the length of the body",
       .required = true,
       .on_command_line = OnCommandLine::no},
      {.key = "direction",
       .value = VectorOption{&sine.direction, &sine.direction_z},
       .label = "Direction",
       .help = "Direction of the displacement; its length does not matter"},
      {.key = "along",
       .value = SpaceVectorOption{&sine.along},
       .label = "Along",
       .help = "Way in which the wave runs over the body, for volume meshes; not given: at right "
               "angles to the direction and to the z axis",
       .applies = sine.along.has_value()},
      {.key = "fade",
       .value = ChoiceOption(sine.fade, {{"none", "Nowhere"},
                                         {"start", "At the start"},
                                         {"end", "At the end"},
                                         {"both", "At both ends"}}),
       .label = "Fade",
       .help = "Ends of the body at which the wave fades to zero"},
      {.key = "fade_length",
       .value = RealOption{&sine.fade_length, {.low = 0, .high = 0.5, .low_included = false}},
       .label = "Fade length",
       .help = "Share of the body's length over which it fades",
       .applies = sine.fade != Fade::none},
  };
}

}  // namespace winslow
