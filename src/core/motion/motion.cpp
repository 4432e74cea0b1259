#include "core/motion/motion.h"

#include <Eigen/Geometry>
#include <iterator>

#include "core/error.h"

namespace winslow {

namespace {

template <int D>
class Rigid final : public Motion {
 public:
  /// motion: resolved.
  Rigid(std::vector<Index> nodes, const RigidMotion& motion)
      : nodes_(std::move(nodes)),
        rotate_(motion.rotate),
        pivot_(motion.pivot->head<D>()),
        translate_(motion.translate.head<D>()),
        axis_(axis_of(motion).normalized()) {}

  std::span<const Index> nodes() const override { return nodes_; }

  void apply(const Coordinates& rest, double fraction, Coordinates& out) const override {
    const Eigen::Matrix<double, D, D> rotation = rotation_by(radians(rotate_ * fraction));
    for (const Index node : nodes_) {
      const Vec<D> p = rest.get<D>(node);
      // A pure translation must not pass through the pivot: that would round.
      const Vec<D> turned = rotate_ == 0 ? p : Vec<D>(pivot_ + rotation * (p - pivot_));
      out.set<D>(node, turned + fraction * translate_);
    }
  }

 private:
  Eigen::Matrix<double, D, D> rotation_by(double angle) const {
    if constexpr (D == 2)
      return Eigen::Rotation2D<double>(angle).toRotationMatrix();
    else
      return Eigen::AngleAxisd(angle, axis_).toRotationMatrix();
  }

  std::vector<Index> nodes_;
  double rotate_;
  Vec<D> pivot_, translate_;
  Vec3 axis_;
};

class Bodies final : public Motion {
 public:
  explicit Bodies(std::vector<std::unique_ptr<Motion>> bodies) : bodies_(std::move(bodies)) {
    for (const auto& body : bodies_)
      nodes_.insert(nodes_.end(), body->nodes().begin(), body->nodes().end());
    std::ranges::sort(nodes_);
    nodes_.erase(std::unique(nodes_.begin(), nodes_.end()), nodes_.end());
  }

  std::span<const Index> nodes() const override { return nodes_; }
  std::span<const std::unique_ptr<Motion>> bodies() const override { return bodies_; }
  void apply(const Coordinates& rest, double fraction, Coordinates& out) const override {
    for (const auto& body : bodies_) body->apply(rest, fraction, out);
  }

 private:
  std::vector<std::unique_ptr<Motion>> bodies_;
  std::vector<Index> nodes_;
};

void require_own_markers(std::span<const MovingBody> bodies) {
  std::vector<std::string> seen;
  for (const MovingBody& body : bodies) {
    for (const std::string& marker : body.markers)
      if (std::ranges::find(seen, marker) != seen.end())
        throw UsageError("the marker " + marker + " belongs to two of the bodies that are to move");
    seen.insert(seen.end(), body.markers.begin(), body.markers.end());
  }
}

/// The first of some markers that a node belongs to.
std::string marker_at(const Topology& topology, const std::vector<std::string>& markers,
                      Index node) {
  for (const std::string& name : markers) {
    const std::vector<Index> nodes = topology.markers().nodes_of(std::span(&name, 1));
    if (std::ranges::binary_search(nodes, node)) return name;
  }
  return {};
}

/// A node of two bodies stays one node: both have to take it along the same arc.
class SharedNodes {
 public:
  SharedNodes(const Topology& topology, const Coordinates& rest, std::span<const MovingBody> bodies,
              std::span<const std::unique_ptr<Motion>> motions)
      : topology_(topology), rest_(rest), bodies_(bodies), motions_(motions) {}

  void require_together() const {
    for (std::size_t b = 1; b < motions_.size(); ++b)
      for (std::size_t a = 0; a < b; ++a) require_together(a, b);
  }

 private:
  void require_together(std::size_t a, std::size_t b) const {
    std::vector<Index> shared;
    std::ranges::set_intersection(motions_[a]->nodes(), motions_[b]->nodes(),
                                  std::back_inserter(shared));
    if (shared.empty()) return;
    constexpr double relative = 1e-9;  // of rounding errors
    const double least = relative * body_box(rest_, motions_[b]->nodes()).size().norm();
    // Arcs that meet at four fractions are the same.
    for (const double fraction : {0.25, 0.5, 0.75, 1.0}) {
      Coordinates by_a = rest_, by_b = rest_;
      motions_[a]->apply(rest_, fraction, by_a);
      motions_[b]->apply(rest_, fraction, by_b);
      for (const Index node : shared)
        if (distance(by_a, by_b, node) > least) refuse(a, b, node);
    }
  }

  static double distance(const Coordinates& x, const Coordinates& y, Index node) {
    return x.dimension() == 3 ? (x.xyz(node) - y.xyz(node)).norm()
                              : (x.xy(node) - y.xy(node)).norm();
  }

  [[noreturn]] void refuse(std::size_t a, std::size_t b, Index node) const {
    throw UsageError("the markers " + marker_at(topology_, bodies_[a].markers, node) + " and " +
                     marker_at(topology_, bodies_[b].markers, node) + " share node " +
                     std::to_string(node) + ", which their motions take to different places");
  }

  const Topology& topology_;
  const Coordinates& rest_;
  std::span<const MovingBody> bodies_;
  std::span<const std::unique_ptr<Motion>> motions_;
};

}  // namespace

std::unique_ptr<Motion> make_motion(const Topology& topology, const Coordinates& rest,
                                    const std::vector<std::string>& markers,
                                    const RigidMotion& options) {
  const bool volume = topology.cell_dimension() == 3;
  if (!volume) require_plane(topology, "rigid motions");
  std::vector<Index> nodes = moving_nodes(topology, markers);
  const RigidMotion motion =
      resolve_motion(options, volume ? 3 : 2, body_centre(body_box(rest, nodes)));
  if (volume) return std::make_unique<Rigid<3>>(std::move(nodes), motion);
  return std::make_unique<Rigid<2>>(std::move(nodes), motion);
}

std::unique_ptr<Motion> make_motion(const Topology& topology, const Coordinates& rest,
                                    std::span<const MovingBody> bodies) {
  if (bodies.empty()) throw UsageError("no body given: what is to move?");
  require_own_markers(bodies);
  std::vector<std::unique_ptr<Motion>> motions;
  for (const MovingBody& body : bodies)
    motions.push_back(make_motion(topology, rest, body.markers, body.motion));
  if (motions.size() == 1) return std::move(motions.front());
  SharedNodes(topology, rest, bodies, motions).require_together();
  return std::make_unique<Bodies>(std::move(motions));
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

OptionTable option_table(RigidMotion& motion) {
  // What the program found is of space where it has an axis.
  const int numbers = motion.axis ? 3 : 2;
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
       .value = OptionalVectorOption{&motion.pivot, numbers},
       .label = "Pivot",
       .help = "Point about which it turns; not given: the centre of the bounding box of all that "
               "moves",
       .unit = "units of the mesh",
       .applies = motion.pivot.has_value()},
      {.key = "translate",
       .value = VectorOption{&motion.translate, numbers},
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
       .value = VectorOption{&sine.direction},
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
