#include "core/motion/transfer.h"

#include <Eigen/Geometry>

#include "core/motion/rigid_motion.h"

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
      // What is not rigid turns with the body.
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

/// Every node in a straight line.
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

std::unique_ptr<Motion> make_straight(const NodeClasses& classes, const Coordinates& from,
                                      const Coordinates& to) {
  std::vector<Index> nodes;
  for (Index node = 0; node < from.size(); ++node) {
    if (!classes.moves(node) && !from.same_place(node, to)) nodes.push_back(node);
  }
  return std::make_unique<StraightTransfer>(std::move(nodes), to);
}

}  // namespace

std::unique_ptr<Motion> make_transfer(const NodeClasses& classes, const Coordinates& from,
                                      const Coordinates& to) {
  if (from.dimension() == 3) return make_straight(classes, from, to);
  require_plane(classes.topology(), "motions");
  std::vector<Index> nodes;
  for (Index node = 0; node < from.size(); ++node) {
    if (!classes.moves(node) && from.xy(node) != to.xy(node)) nodes.push_back(node);
  }
  return std::make_unique<Transfer>(std::move(nodes), from, to);
}

}  // namespace winslow
