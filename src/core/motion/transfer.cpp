#include "core/motion/transfer.h"

#include <Eigen/QR>

#include "core/motion/rigid_motion.h"
#include "core/quality/quality.h"

namespace winslow {

namespace {

class Transfer final : public Motion {
 public:
  Transfer(std::vector<Index> nodes, const Coordinates& from, const Coordinates& to)
      : nodes_(std::move(nodes)) {
    for (const Index node : nodes_) target_.push_back(to.xy(node));
    const RigidMotion fit = fit_rigid_motion(nodes_, from, to);
    centre_ = pivot_of(fit).head<2>();
    target_centre_ = centre_ + fit.translate.head<2>();
    angle_ = radians(fit.rotate);
  }

  std::span<const Index> nodes() const override { return nodes_; }
  void apply(const Coordinates& rest, double fraction, Coordinates& out) const override {
    const Eigen::Rotation2D<double> part(angle_ * fraction), whole(angle_);
    const Vec2 centre = centre_ + fraction * (target_centre_ - centre_);
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
      if (fraction == 1) {
        out.set_xy(nodes_[i], target_[i]);
        continue;
      }
      const Vec2 arm = rest.xy(nodes_[i]) - centre_;
      // The remainder rotates with the body.
      const Vec2 bend = whole.inverse() * Vec2(target_[i] - target_centre_) - arm;
      out.set_xy(nodes_[i], centre + part * Vec2(arm + fraction * bend));
    }
  }

 private:
  std::vector<Index> nodes_;
  Vec2 centre_{0, 0}, target_centre_{0, 0};
  double angle_ = 0;
  std::vector<Vec2> target_;
};

/// Moves every node in a straight line.
class StraightTransfer final : public Motion {
 public:
  StraightTransfer(std::vector<Index> nodes, const Coordinates& to)
      : nodes_(std::move(nodes)), target_(to) {}

  std::span<const Index> nodes() const override { return nodes_; }

  void apply(const Coordinates& rest, double fraction, Coordinates& out) const override {
    for (const Index node : nodes_) {
      if (fraction == 1) {
        out.copy_node(node, target_);
      } else {
        const Vec3 p = place_of(rest, node);
        set_place(out, node, p + fraction * (place_of(target_, node) - p));
      }
    }
  }

 private:
  std::vector<Index> nodes_;
  Coordinates target_;
};

/// Moves bodies along a motion, and every other node in a straight line.
class BodyTransfer final : public Motion {
 public:
  BodyTransfer(std::vector<Index> nodes, const Coordinates& to, const Motion& bodies)
      : straight_(std::move(nodes), to), bodies_(bodies) {
    std::ranges::set_intersection(straight_.nodes(), bodies.nodes(),
                                  std::back_inserter(with_bodies_));
  }

  std::span<const Index> nodes() const override { return straight_.nodes(); }
  const Motion& of_bodies() const override { return bodies_; }
  void apply(const Coordinates& rest, double fraction, Coordinates& out) const override {
    straight_.apply(rest, fraction, out);
    if (fraction == 1) return;
    Coordinates moved = rest;
    bodies_.apply(rest, fraction, moved);
    for (const Index node : with_bodies_) out.copy_node(node, moved);
  }

 private:
  StraightTransfer straight_;
  const Motion& bodies_;
  std::vector<Index> with_bodies_;
};

/// Nodes without unknowns that are elsewhere in the other mesh.
std::vector<Index> prescribed_nodes(const NodeClasses& classes, const Coordinates& from,
                                    const Coordinates& to) {
  std::vector<Index> nodes;
  for (Index node = 0; node < from.size(); ++node)
    if (!classes.moves(node) && !from.same_place(node, to)) nodes.push_back(node);
  return nodes;
}

}  // namespace

std::unique_ptr<Motion> make_transfer(const NodeClasses& classes, const Coordinates& from,
                                      const Coordinates& to) {
  std::vector<Index> nodes = prescribed_nodes(classes, from, to);
  if (from.dimension() == 3) return std::make_unique<StraightTransfer>(std::move(nodes), to);
  return std::make_unique<Transfer>(std::move(nodes), from, to);
}

std::unique_ptr<Motion> make_transfer(const NodeClasses& classes, const Coordinates& from,
                                      const Coordinates& to, const Motion& bodies) {
  return std::make_unique<BodyTransfer>(prescribed_nodes(classes, from, to), to, bodies);
}

Coordinates unknowns_within(const NodeClasses& classes, const Coordinates& unknown,
                            Coordinates held) {
  for (Index node = 0; node < held.size(); ++node) {
    if (classes.moves(node)) held.copy_node(node, unknown);
  }
  return held;
}

namespace {

/// Differences of the places of nodes between two meshes, one after another.
Eigen::VectorXd differences(std::span<const Index> nodes, const Coordinates& from,
                            const Coordinates& to) {
  Eigen::VectorXd out(3 * std::ssize(nodes));
  for (std::size_t i = 0; i < nodes.size(); ++i)
    out.segment<3>(3 * static_cast<Eigen::Index>(i)) =
        place_of(to, nodes[i]) - place_of(from, nodes[i]);
  return out;
}

}  // namespace

std::vector<const Coordinates*> nearest_meshes(std::span<const Coordinates* const> known,
                                               std::span<const Index> nodes,
                                               const Coordinates& target, std::size_t most) {
  struct Near {
    const Coordinates* mesh;
    double distance;
  };
  std::vector<Near> sorted;
  for (const Coordinates* mesh : known)
    sorted.push_back({mesh, differences(nodes, *mesh, target).norm()});
  std::ranges::stable_sort(sorted, {}, &Near::distance);
  // Two meshes that are nearly the same would get large shares of opposite signs.
  constexpr double apart = 0.1;  // of the distance from the target
  std::vector<const Coordinates*> chosen;
  for (const auto& [mesh, distance] : sorted) {
    if (chosen.size() == most) break;
    const double least = apart * distance;
    const bool is_new = std::ranges::all_of(chosen, [&](const Coordinates* other) {
      return differences(nodes, *other, *mesh).norm() > least;
    });
    if (is_new) chosen.push_back(mesh);
  }
  return chosen;
}

std::optional<Coordinates> extrapolated(std::span<const Coordinates* const> known,
                                        std::span<const Index> nodes, const Coordinates& target) {
  const Coordinates& nearest = *known.front();
  const Eigen::VectorXd wanted = differences(nodes, nearest, target);
  const double length = wanted.norm();
  constexpr double round_off = 1e-13;
  double size = 0;
  for (const Index node : nodes) size += place_of(target, node).squaredNorm();
  if (length <= round_off * std::sqrt(size)) return nearest;
  const Eigen::Index count = std::ssize(known) - 1, rows = wanted.size();
  if (count == 0) return std::nullopt;
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(rows + count - 1, count);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(rows + count - 1);
  right.head(rows) = wanted;
  constexpr double soft = 1e-3;
  for (Eigen::Index k = 0; k < count; ++k) {
    matrix.col(k).head(rows) = differences(nodes, nearest, *known[static_cast<std::size_t>(k) + 1]);
    // The way is measured from the nearest mesh, 0, to the target, 1. Powers of it are exact, too.
    const double way = matrix.col(k).head(rows).dot(wanted) / (length * length);
    for (Eigen::Index power = 2; power <= count; ++power) {
      matrix(rows + power - 2, k) = soft * length * std::pow(way, power);
      right(rows + power - 2) = soft * length;
    }
  }
  const Eigen::VectorXd shares = matrix.colPivHouseholderQr().solve(right);
  constexpr double near = 0.1, most = 100;
  const double off = (matrix.topRows(rows) * shares - wanted).norm();
  if (!(off <= near * length) || !(shares.lpNorm<1>() <= most)) return std::nullopt;
  Coordinates out = nearest;
  const auto values = out.values();
  for (Eigen::Index k = 0; k < count; ++k) {
    const auto other = known[static_cast<std::size_t>(k) + 1]->values();
    for (std::size_t i = 0; i < values.size(); ++i)
      values[i] += shares[k] * (other[i] - nearest.values()[i]);
  }
  return out;
}

namespace {

constexpr double degrees_per_frame = 1;
constexpr double moved_per_frame = 0.02;  // of the extent of the moved nodes
constexpr int most_frames = 90;

/// The motion of a body from one mesh to another.
template <int D>
class Way {
 public:
  Way(std::span<const Index> nodes, const Coordinates& from, const Coordinates& to)
      : whole_(fit_rigid_motion(nodes, from, to)) {
    Box<D> box = Box<D>::empty();
    for (const Index node : nodes) box.add(from.get<D>(node));
    centre_ = box.centre();
    extent_ = box.size().norm();
    way_ = transform(whole_, centre_) - centre_;
    part_ = whole_;
  }

  int frames() const {
    const double by_way = extent_ > 0 ? way_.norm() / (moved_per_frame * extent_) : 0;
    const double wanted = std::max(std::abs(whole_.rotate) / degrees_per_frame, by_way);
    return static_cast<int>(std::ceil(std::min(wanted, static_cast<double>(most_frames)) - 1e-9));
  }

  /// Sets the share of the motion: of the angle and of the displacement of the centre.
  void go_to(double share) {
    part_ = whole_;
    part_.rotate *= share;
    part_.pivot = centre_;
    part_.translate = Vec<D>(share * way_);
  }
  /// How far a node that moves from a to b follows the body's motion: 0 (not at all) to 1
  /// (completely).
  double share_of(const Vec<D>& a, const Vec<D>& b) const {
    const double stays = (b - a).norm(), goes = (b - transform(whole_, a)).norm();
    return stays + goes > 0 ? stays / (stays + goes) : 0;
  }
  /// Position of a node that moves from a to b with the body, after a share of the motion.
  Vec<D> carried(const Vec<D>& a, const Vec<D>& b, double share) const {
    const Vec<D> back = transform_back(whole_, b);
    return transform(part_, Vec<D>(a + share * (back - a)));
  }

 private:
  RigidMotion whole_, part_;
  Vec<D> centre_, way_;
  double extent_ = 0;
};

template <int D>
std::vector<Coordinates> between(const Topology& topology,
                                 std::span<const std::vector<Index>> bodies,
                                 const Coordinates& from, const Coordinates& to) {
  std::vector<Way<D>> ways;
  int frames = 0;
  for (const std::vector<Index>& nodes : bodies) {
    if (nodes.empty()) continue;
    frames = std::max(frames, ways.emplace_back(nodes, from, to).frames());
  }
  std::vector<Coordinates> meshes;
  for (int k = 1; k < frames; ++k) {
    const double t = static_cast<double>(k) / frames;
    for (Way<D>& way : ways) way.go_to(t);
    Coordinates x = from;
    for (Index i = 0; i < x.size(); ++i) {
      const Vec<D> a = from.get<D>(i), b = to.get<D>(i);
      const auto leader =
          std::ranges::max_element(ways, {}, [&](const Way<D>& way) { return way.share_of(a, b); });
      // Straight for fixed nodes, with the body for those that follow it: straight lines would
      // crush thin layers at a rotating body.
      const Vec<D> straight = a + t * (b - a);
      const Vec<D> carried = leader->carried(a, b, t);
      x.set<D>(i, straight + leader->share_of(a, b) * (carried - straight));
    }
    if (check_validity(topology, x).inverted == 0) meshes.push_back(std::move(x));
  }
  return meshes;
}

}  // namespace

std::vector<Coordinates> meshes_between(const Topology& topology,
                                        std::span<const std::vector<Index>> bodies,
                                        const Coordinates& from, const Coordinates& to) {
  if (from.size() != to.size()) return {};
  return in_dimension(
      from, [&]<int D>(const Points<D>&) { return between<D>(topology, bodies, from, to); });
}

}  // namespace winslow
