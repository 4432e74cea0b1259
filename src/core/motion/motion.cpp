#include "core/motion/motion.h"

#include <Eigen/Geometry>
#include <iterator>

#include "core/error.h"
#include "core/mesh/mesh.h"

namespace winslow {

namespace {

template <int D>
class Rigid final : public Motion {
 public:
  /// motion: resolved.
  Rigid(std::vector<Index> nodes, const RigidMotion& motion)
      : nodes_(std::move(nodes)),
        motion_(motion),
        pivot_(motion.pivot->head<D>()),
        translate_(motion.translate.head<D>()),
        axis_(axis_of(motion).normalized()) {}

  std::span<const Index> nodes() const override { return nodes_; }
  const RigidMotion* rigid() const override { return &motion_; }
  bool moves() const override { return motion_.rotate != 0 || !translate_.isZero(0); }

  void apply(const Coordinates& rest, double fraction, Coordinates& out) const override {
    const Eigen::Matrix<double, D, D> rotation = rotation_by(radians(motion_.rotate * fraction));
    for (const Index node : nodes_) {
      const Vec<D> p = rest.get<D>(node);
      // A pure translation must not use the pivot, which would cause rounding.
      const Vec<D> turned = motion_.rotate == 0 ? p : Vec<D>(pivot_ + rotation * (p - pivot_));
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
  RigidMotion motion_;
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
  bool moves() const override {
    return std::ranges::any_of(bodies_, [](const auto& body) { return body->moves(); });
  }
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

/// The first of the given markers to which a node belongs.
std::string marker_at(const Topology& topology, const std::vector<std::string>& markers,
                      Index node) {
  for (const std::string& name : markers) {
    const std::vector<Index> nodes = topology.markers().nodes_of(std::span(&name, 1));
    if (std::ranges::binary_search(nodes, node)) return name;
  }
  return {};
}

/// Both bodies of a common node must move it along the same arc.
void require_together(const Topology& topology, const Coordinates& rest,
                      std::array<const MovingBody*, 2> bodies,
                      std::array<const Motion*, 2> motions) {
  std::vector<Index> shared;
  std::ranges::set_intersection(motions[0]->nodes(), motions[1]->nodes(),
                                std::back_inserter(shared));
  if (shared.empty()) return;
  double apart = 0;
  Index worst = shared.front();
  Coordinates by_one = rest, by_other = rest;
  // At quarters a body that turns four times would be back where it was.
  for (const double fraction : {0.1459, 0.2361, 0.3820, 0.5279, 0.7639, 0.9098, 1.0}) {
    motions[0]->apply(rest, fraction, by_one);
    motions[1]->apply(rest, fraction, by_other);
    for (const Index node : shared) {
      const double here = (place_of(by_one, node) - place_of(by_other, node)).norm();
      if (here <= apart) continue;
      apart = here;
      worst = node;
    }
  }
  constexpr double relative = 1e-9;  // of rounding errors
  if (apart <= relative * body_box(rest, motions[1]->nodes()).size().norm()) return;
  throw UsageError("the markers " + marker_at(topology, bodies[0]->markers, worst) + " and " +
                   marker_at(topology, bodies[1]->markers, worst) + " share node " +
                   std::to_string(worst) + ", which their motions take to different places, " +
                   number_text(apart) +
                   " apart: make them one body, or let both turn about that node");
}

}  // namespace

std::unique_ptr<Motion> make_motion(const Topology& topology, const Coordinates& rest,
                                    const std::vector<std::string>& markers,
                                    const RigidMotion& options) {
  return in_dimension(topology, "rigid motions", [&](auto dim) -> std::unique_ptr<Motion> {
    std::vector<Index> nodes = moving_nodes(topology, markers);
    const RigidMotion motion = resolve_motion(options, dim, body_centre(body_box(rest, nodes)));
    return std::make_unique<Rigid<dim()>>(std::move(nodes), motion);
  });
}

std::unique_ptr<Motion> make_motion(const Topology& topology, const Coordinates& rest,
                                    std::span<const MovingBody> bodies) {
  if (bodies.empty()) throw UsageError("no body given: what is to move?");
  require_own_markers(bodies);
  std::vector<std::unique_ptr<Motion>> motions;
  for (const MovingBody& body : bodies)
    motions.push_back(make_motion(topology, rest, body.markers, body.motion));
  if (motions.size() == 1) return std::move(motions.front());
  for (std::size_t b = 1; b < motions.size(); ++b)
    for (std::size_t a = 0; a < b; ++a)
      require_together(topology, rest, {&bodies[a], &bodies[b]},
                       {motions[a].get(), motions[b].get()});
  return std::make_unique<Bodies>(std::move(motions));
}

std::vector<Index> moving_nodes(const Topology& topology, const std::vector<std::string>& markers) {
  if (markers.empty()) throw UsageError("no marker given: which boundary is to move?");
  std::vector<Index> nodes = topology.markers().nodes_of(markers);
  if (nodes.empty()) throw UsageError("the chosen markers have no nodes");
  return nodes;
}

double smooth_step(double t) {
  t = std::clamp(t, 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

void require_finite(double value, const char* what) {
  if (!std::isfinite(value)) throw UsageError(std::string(what) + " is not a finite number");
}

OptionTable option_table(RigidMotion& motion) {
  // Computed motions are spatial if they have an axis.
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

namespace {

/// Moves nodes in straight lines, in proportion to the fraction.
template <int D>
class Straight final : public Motion {
 public:
  Straight(std::vector<Index> nodes, std::vector<Vec<D>> ways, std::vector<Vec<D>> ends)
      : nodes_(std::move(nodes)), ways_(std::move(ways)), ends_(std::move(ends)) {}
  std::span<const Index> nodes() const override { return nodes_; }
  bool moves() const override {
    return !std::ranges::all_of(ways_, [](const auto& by) { return by.isZero(0); });
  }
  void apply(const Coordinates& rest, double fraction, Coordinates& out) const override {
    const bool at_end = fraction == 1 && !ends_.empty();
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
      const Vec<D> place = at_end ? ends_[i] : rest.get<D>(nodes_[i]) + fraction * ways_[i];
      out.set<D>(nodes_[i], place);
    }
  }

 private:
  std::vector<Index> nodes_;
  std::vector<Vec<D>> ways_, ends_;
};

double fade_factor(const SineDeformation& options, double s) {
  double factor = 1;
  if (options.fade == Fade::start || options.fade == Fade::both) {
    factor *= smooth_step(s / options.fade_length);
  }
  if (options.fade == Fade::end || options.fade == Fade::both) {
    factor *= smooth_step((1 - s) / options.fade_length);
  }
  return factor;
}

/// Unit vectors: the direction of the displacement, and the direction in which the sine varies.
template <int D>
std::pair<Vec<D>, Vec<D>> directions_of(const SineDeformation& options);

template <>
std::pair<Vec3, Vec3> directions_of<3>(const SineDeformation& options) {
  const Vec3& direction = options.direction;
  if (options.along) {
    require_finite(options.along->sum(), "the way along which the sine runs");
    if (options.along->norm() == 0) throw UsageError("the way along which the sine runs is zero");
    return {direction.normalized(), options.along->normalized()};
  }
  const Vec3 across = direction.cross(Vec3::UnitZ());
  constexpr double least = 1e-9;
  if (across.norm() <= least * direction.norm())
    throw UsageError("a sine whose direction is that of z needs a way along which it runs (along)");
  return {direction.normalized(), across.normalized()};
}

template <>
std::pair<Vec2, Vec2> directions_of<2>(const SineDeformation& options) {
  if (options.along || options.direction.leaves_plane())
    throw UsageError(
        "a way along which a sine runs or a third component: only for a volume mesh, and this is a "
        "plane mesh");
  const Vec2 direction = Vec2(options.direction.head<2>()).normalized();
  return {direction, Vec2(direction.y(), -direction.x())};
}

/// Displacements of nodes: wave(s) along the direction, faded.
template <int D, typename Wave>
std::vector<Vec<D>> ways_by(const Wave& wave, std::span<const Index> nodes, const Coordinates& rest,
                            const SineDeformation& options) {
  const auto [direction, along] = directions_of<D>(options);
  double low = along.dot(rest.get<D>(nodes.front())), high = low;
  for (const Index node : nodes) {
    low = std::min(low, along.dot(rest.get<D>(node)));
    high = std::max(high, along.dot(rest.get<D>(node)));
  }
  if (!(high > low)) throw UsageError("the chosen markers have no extent across the direction");
  std::vector<Vec<D>> ways;
  ways.reserve(nodes.size());
  for (const Index node : nodes) {
    const double s = (along.dot(rest.get<D>(node)) - low) / (high - low);
    ways.emplace_back(fade_factor(options, s) * wave(s) * direction);
  }
  return ways;
}

void validate(const SineDeformation& options) {
  require_finite(options.amplitude, "the amplitude");
  require_finite(options.waves, "the number of waves");
  require_finite(options.direction.sum(), "the direction");
  if (options.direction.norm() == 0) throw UsageError("the direction of the sine is zero");
  if (!(options.fade_length > 0 && options.fade_length <= 0.5))
    throw UsageError("the fade length is not in (0, 0.5]");
}

}  // namespace

template <int D>
std::unique_ptr<Motion> straight_motion(std::vector<Index> nodes, std::vector<Vec<D>> ways,
                                        std::vector<Vec<D>> ends) {
  return std::make_unique<Straight<D>>(std::move(nodes), std::move(ways), std::move(ends));
}
template std::unique_ptr<Motion> straight_motion<2>(std::vector<Index>, std::vector<Vec2>,
                                                    std::vector<Vec2>);
template std::unique_ptr<Motion> straight_motion<3>(std::vector<Index>, std::vector<Vec3>,
                                                    std::vector<Vec3>);

std::unique_ptr<Motion> make_motion(const Topology& topology, const Coordinates& rest,
                                    const std::vector<std::string>& markers,
                                    const SineDeformation& options) {
  return in_dimension(topology, "sine deformations", [&](auto dim) {
    validate(options);
    std::vector<Index> nodes = moving_nodes(topology, markers);
    const auto wave = [&](double s) {
      return options.amplitude * std::sin(2 * pi * options.waves * s);
    };
    std::vector<Vec<dim()>> ways = ways_by<dim()>(wave, nodes, rest, options);
    return straight_motion<dim()>(std::move(nodes), std::move(ways));
  });
}

Coordinates sine_velocities(const Topology& topology, const Coordinates& rest,
                            const std::vector<std::string>& markers, const SineDeformation& options,
                            SineParameter parameter) {
  return in_dimension(topology, "sine deformations", [&](auto dim) {
    validate(options);
    const std::vector<Index> nodes = moving_nodes(topology, markers);
    const auto slope = [&](double s) {
      const double phase = 2 * pi * options.waves * s;
      if (parameter == SineParameter::amplitude) return std::sin(phase);
      return options.amplitude * 2 * pi * s * std::cos(phase);
    };
    const std::vector<Vec<dim()>> ways = ways_by<dim()>(slope, nodes, rest, options);
    Coordinates out(rest.dimension(), rest.size());
    for (std::size_t k = 0; k < nodes.size(); ++k) out.set<dim()>(nodes[k], ways[k]);
    return out;
  });
}

}  // namespace winslow
