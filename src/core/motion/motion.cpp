#include "core/motion/motion.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/mesh/mesh.h"
#include "core/search/box_tree.h"

namespace winslow {

namespace {

std::vector<Index> moving_nodes(const Topology& topology, const std::vector<std::string>& markers) {
  if (markers.empty()) throw UsageError("no marker given: which boundary is to move?");
  std::vector<Index> nodes = topology.markers().nodes_of(markers);
  if (nodes.empty()) throw UsageError("the chosen markers have no nodes");
  return nodes;
}

void require_finite(double value, const char* what) {
  if (!std::isfinite(value)) throw UsageError(std::string(what) + " is not a finite number");
}

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

/// Displacements known once and for all, applied in proportion.
class Displaced final : public Motion {
 public:
  Displaced(std::vector<Index> nodes, std::vector<Vec2> displacements)
      : nodes_(std::move(nodes)), displacements_(std::move(displacements)) {}
  std::span<const Index> nodes() const override { return nodes_; }
  void apply(const Coordinates& rest, double fraction, Coordinates& out) const override {
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
      out.set_xy(nodes_[i], rest.xy(nodes_[i]) + fraction * displacements_[i]);
    }
  }

 private:
  std::vector<Index> nodes_;
  std::vector<Vec2> displacements_;
};

/// 0 at t <= 0, 1 at t >= 1, with continuous slope.
double smooth_step(double t) {
  t = std::clamp(t, 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

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

/// Matches entries given by position to nodes: the nearest within a tolerance.
class NodeFinder {
 public:
  NodeFinder(const Coordinates& x, const std::vector<Index>& nodes) : nodes_(nodes) {
    std::vector<Vec2> places;
    places.reserve(nodes.size());
    for (const Index node : nodes) places.push_back(x.xy(node));
    tree_ = BoxTree<2>(places);
    // Files written with six or seven digits must match.
    constexpr double relative = 1e-6;
    tolerance_ = relative * bounds(x, nodes).size().maxCoeff();
  }

  std::optional<Index> find(const Vec2& p) const {
    const auto found = tree_.nearest(p, tolerance_);
    if (!found) return std::nullopt;
    return nodes_[static_cast<std::size_t>(found->item)];
  }

 private:
  const std::vector<Index>& nodes_;
  BoxTree<2> tree_;  // of nodes_
  double tolerance_ = 0;
};

[[noreturn]] void refuse_entry(const DisplacementTable& table, std::size_t k,
                               const std::string& why) {
  const DisplacementEntry& entry = table.entries[k];
  const std::string file = table.source.empty() ? "displacements" : table.source;
  const std::string line = entry.line > 0 ? ":" + std::to_string(entry.line) : "";
  const std::string who = entry.node ? "node " + std::to_string(*entry.node)
                                     : "position (" + std::to_string(entry.position.x()) + ", " +
                                           std::to_string(entry.position.y()) + ")";
  throw UsageError(file + line + ": " + who + " " + why);
}

}  // namespace

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

std::unique_ptr<Motion> make_motion(const Topology& topology, const Coordinates& rest,
                                    const std::vector<std::string>& markers,
                                    const SineDeformation& options) {
  require_plane(topology, "sine deformations");
  require_finite(options.amplitude, "the amplitude");
  require_finite(options.waves, "the number of waves");
  require_finite(options.direction.sum(), "the direction");
  if (options.direction.norm() == 0) throw UsageError("the direction of the sine is zero");
  if (!(options.fade_length > 0 && options.fade_length <= 0.5)) {
    throw UsageError("the fade length is not in (0, 0.5]");
  }
  std::vector<Index> nodes = moving_nodes(topology, markers);
  const Vec2 direction = options.direction.normalized();
  const Vec2 along(direction.y(), -direction.x());
  double low = along.dot(rest.xy(nodes.front())), high = low;
  for (const Index node : nodes) {
    low = std::min(low, along.dot(rest.xy(node)));
    high = std::max(high, along.dot(rest.xy(node)));
  }
  if (!(high > low)) throw UsageError("the chosen markers have no extent across the direction");
  std::vector<Vec2> displacements;
  displacements.reserve(nodes.size());
  for (const Index node : nodes) {
    const double s = (along.dot(rest.xy(node)) - low) / (high - low);
    const double height =
        options.amplitude * fade_factor(options, s) * std::sin(2 * pi * options.waves * s);
    displacements.emplace_back(height * direction);
  }
  return std::make_unique<Displaced>(std::move(nodes), std::move(displacements));
}

std::unique_ptr<Motion> make_motion(const Topology& topology, const Coordinates& rest,
                                    const std::vector<std::string>& markers,
                                    const DisplacementTable& table) {
  require_plane(topology, "displacements");
  std::vector<Index> nodes = moving_nodes(topology, markers);
  if (table.entries.empty()) throw UsageError("the displacement table is empty");
  const NodeFinder finder(rest, nodes);
  std::vector<Vec2> displacements(nodes.size(), Vec2(0, 0));
  std::vector<unsigned char> given(nodes.size(), 0);
  for (std::size_t k = 0; k < table.entries.size(); ++k) {
    const DisplacementEntry& entry = table.entries[k];
    if (!entry.displacement.allFinite()) {
      refuse_entry(table, k, "has a displacement that is not finite");
    }
    const auto node = entry.node ? entry.node : finder.find(entry.position);
    if (!node) refuse_entry(table, k, "matches no node of the chosen markers");
    const auto it = std::lower_bound(nodes.begin(), nodes.end(), *node);
    if (it == nodes.end() || *it != *node) {
      refuse_entry(table, k, "does not belong to the chosen markers");
    }
    const auto i = static_cast<std::size_t>(it - nodes.begin());
    if (given[i]) refuse_entry(table, k, "is given twice");
    given[i] = 1;
    displacements[i] = entry.displacement;
  }
  return std::make_unique<Displaced>(std::move(nodes), std::move(displacements));
}

}  // namespace winslow
