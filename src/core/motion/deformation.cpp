#include <Eigen/Geometry>

#include "core/error.h"
#include "core/mesh/mesh.h"
#include "core/motion/motion.h"
#include "core/search/box_tree.h"

namespace winslow {

namespace {

/// Displacements known once and for all, applied in proportion.
template <int D>
class Displaced final : public Motion {
 public:
  Displaced(std::vector<Index> nodes, std::vector<Vec<D>> displacements)
      : nodes_(std::move(nodes)), displacements_(std::move(displacements)) {}
  std::span<const Index> nodes() const override { return nodes_; }
  void apply(const Coordinates& rest, double fraction, Coordinates& out) const override {
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
      const Vec<D> place = rest.get<D>(nodes_[i]) + fraction * displacements_[i];
      out.set<D>(nodes_[i], place);
    }
  }

 private:
  std::vector<Index> nodes_;
  std::vector<Vec<D>> displacements_;
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

/// direction, along: of length 1.
template <int D>
std::unique_ptr<Motion> sine_motion(std::vector<Index> nodes, const Coordinates& rest,
                                    const SineDeformation& options, const Vec<D>& direction,
                                    const Vec<D>& along) {
  double low = along.dot(rest.get<D>(nodes.front())), high = low;
  for (const Index node : nodes) {
    low = std::min(low, along.dot(rest.get<D>(node)));
    high = std::max(high, along.dot(rest.get<D>(node)));
  }
  if (!(high > low)) throw UsageError("the chosen markers have no extent across the direction");
  std::vector<Vec<D>> displacements;
  displacements.reserve(nodes.size());
  for (const Index node : nodes) {
    const double s = (along.dot(rest.get<D>(node)) - low) / (high - low);
    const double height =
        options.amplitude * fade_factor(options, s) * std::sin(2 * pi * options.waves * s);
    displacements.emplace_back(height * direction);
  }
  return std::make_unique<Displaced<D>>(std::move(nodes), std::move(displacements));
}

/// The way in which a sine runs in space.
Vec3 way_of(const SineDeformation& options, const Vec3& direction) {
  if (options.along) {
    require_finite(options.along->sum(), "the way along which the sine runs");
    if (options.along->norm() == 0) throw UsageError("the way along which the sine runs is zero");
    return options.along->normalized();
  }
  const Vec3 across = direction.cross(Vec3::UnitZ());
  constexpr double least = 1e-9;
  if (across.norm() <= least * direction.norm())
    throw UsageError("a sine whose direction is that of z needs a way along which it runs (along)");
  return across.normalized();
}

bool is_volume(const Topology& topology) { return topology.cell_dimension() == 3; }

/// Matches entries given by position to nodes: the nearest within a tolerance.
template <int D>
class NodeFinder {
 public:
  NodeFinder(const Coordinates& x, const std::vector<Index>& nodes) : nodes_(nodes) {
    std::vector<Vec<D>> places;
    places.reserve(nodes.size());
    Box<D> box = Box<D>::empty();
    for (const Index node : nodes) {
      places.push_back(x.get<D>(node));
      box.add(places.back());
    }
    tree_ = BoxTree<D>(places);
    // Files written with six or seven digits must match.
    constexpr double relative = 1e-6;
    tolerance_ = relative * box.size().maxCoeff();
  }

  std::optional<Index> find(const Vec<D>& p) const {
    const auto found = tree_.nearest(p, tolerance_);
    if (!found) return std::nullopt;
    return nodes_[static_cast<std::size_t>(found->item)];
  }

 private:
  const std::vector<Index>& nodes_;
  BoxTree<D> tree_;  // of nodes_
  double tolerance_ = 0;
};

std::string place_of_entry(const DisplacementEntry& entry) {
  const GivenVector& p = entry.position;
  std::string text = "position (" + std::to_string(p.x()) + ", " + std::to_string(p.y());
  if (p.numbers(2) == 3) text += ", " + std::to_string(p.z());
  return text + ")";
}

[[noreturn]] void refuse_entry(const DisplacementTable& table, std::size_t k,
                               const std::string& why) {
  const DisplacementEntry& entry = table.entries[k];
  const std::string file = table.source.empty() ? "displacements" : table.source;
  const std::string line = entry.line > 0 ? ":" + std::to_string(entry.line) : "";
  const std::string who =
      entry.node ? "node " + std::to_string(*entry.node) : place_of_entry(entry);
  throw UsageError(file + line + ": " + who + " " + why);
}

/// Something of an entry. Throws UsageError for a component too few.
template <int D>
Vec<D> components(const DisplacementTable& table, std::size_t k, const GivenVector& given,
                  const char* missing) {
  if (given.numbers(D) < D)
    refuse_entry(table, k,
                 std::string("has no ") + missing +
                     ": found a table for plane meshes, expected node,dx,dy,dz or x,y,z,dx,dy,dz");
  return given.head<D>();
}

template <int D>
std::unique_ptr<Motion> table_motion(std::vector<Index> nodes, const Coordinates& rest,
                                     const DisplacementTable& table) {
  const NodeFinder<D> finder(rest, nodes);
  std::vector<Vec<D>> displacements(nodes.size(), Vec<D>::Zero());
  std::vector<unsigned char> given(nodes.size(), 0);
  for (std::size_t k = 0; k < table.entries.size(); ++k) {
    const DisplacementEntry& entry = table.entries[k];
    const Vec<D> displacement = components<D>(table, k, entry.displacement, "dz");
    if (!displacement.allFinite()) {
      refuse_entry(table, k, "has a displacement that is not finite");
    }
    std::optional<Index> node = entry.node;
    if (!node) node = finder.find(components<D>(table, k, entry.position, "z"));
    if (!node) refuse_entry(table, k, "matches no node of the chosen markers");
    const auto it = std::lower_bound(nodes.begin(), nodes.end(), *node);
    if (it == nodes.end() || *it != *node) {
      refuse_entry(table, k, "does not belong to the chosen markers");
    }
    const auto i = static_cast<std::size_t>(it - nodes.begin());
    if (given[i]) refuse_entry(table, k, "is given twice");
    given[i] = 1;
    displacements[i] = displacement;
  }
  return std::make_unique<Displaced<D>>(std::move(nodes), std::move(displacements));
}

}  // namespace

std::unique_ptr<Motion> make_motion(const Topology& topology, const Coordinates& rest,
                                    const std::vector<std::string>& markers,
                                    const SineDeformation& options) {
  if (!is_volume(topology)) require_plane(topology, "sine deformations");
  require_finite(options.amplitude, "the amplitude");
  require_finite(options.waves, "the number of waves");
  require_finite(options.direction.sum(), "the direction");
  if (options.direction.norm() == 0) throw UsageError("the direction of the sine is zero");
  if (!(options.fade_length > 0 && options.fade_length <= 0.5)) {
    throw UsageError("the fade length is not in (0, 0.5]");
  }
  std::vector<Index> nodes = moving_nodes(topology, markers);
  if (is_volume(topology)) {
    return sine_motion<3>(std::move(nodes), rest, options, options.direction.normalized(),
                          way_of(options, options.direction));
  }
  if (options.along || options.direction.leaves_plane()) {
    throw UsageError(
        "a way along which a sine runs or a third component: only for a volume mesh, and this is a "
        "plane mesh");
  }
  const Vec2 direction = Vec2(options.direction.head<2>()).normalized();
  return sine_motion<2>(std::move(nodes), rest, options, direction,
                        Vec2(direction.y(), -direction.x()));
}

std::unique_ptr<Motion> make_motion(const Topology& topology, const Coordinates& rest,
                                    const std::vector<std::string>& markers,
                                    const DisplacementTable& table) {
  if (!is_volume(topology)) require_plane(topology, "displacements");
  std::vector<Index> nodes = moving_nodes(topology, markers);
  if (table.entries.empty()) throw UsageError("the displacement table is empty");
  return is_volume(topology) ? table_motion<3>(std::move(nodes), rest, table)
                             : table_motion<2>(std::move(nodes), rest, table);
}

}  // namespace winslow
