#include "core/motion/transfer.h"

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
        const Vec3 p = rest.xyz(node);
        out.set_xyz(node, p + fraction * (target_.xyz(node) - p));
      }
    }
  }

 private:
  std::vector<Index> nodes_;
  Coordinates target_;
};

}  // namespace

std::unique_ptr<Motion> make_transfer(const NodeClasses& classes, const Coordinates& from,
                                      const Coordinates& to) {
  std::vector<Index> nodes;
  for (Index node = 0; node < from.size(); ++node)
    if (!classes.moves(node) && !from.same_place(node, to)) nodes.push_back(node);
  if (from.dimension() == 3) return std::make_unique<StraightTransfer>(std::move(nodes), to);
  return std::make_unique<Transfer>(std::move(nodes), from, to);
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
