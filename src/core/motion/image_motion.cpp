#include "core/motion/image_motion.h"

#include <map>

#include "core/error.h"

namespace winslow {
namespace {

/// A node that goes the way of another one, turned.
struct Follower {
  Index node, leader;
  Eigen::Matrix3d rotation;
};

class ImageMotion final : public Motion {
 public:
  ImageMotion(const Motion& motion, std::vector<Follower> followers)
      : motion_(motion), followers_(std::move(followers)) {
    nodes_.assign(motion.nodes().begin(), motion.nodes().end());
    for (const Follower& follower : followers_) nodes_.push_back(follower.node);
    std::ranges::sort(nodes_);
  }

  std::span<const Index> nodes() const override { return nodes_; }
  bool moves() const override { return motion_.moves(); }
  std::span<const std::unique_ptr<Motion>> bodies() const override { return motion_.bodies(); }
  std::vector<TakenNode> taken(const Coordinates& x) const override {
    std::vector<TakenNode> all = motion_.taken(x);
    for (const auto& [node, leader, rotation] : followers_)
      all.push_back({node, {{leader, rotation}}});
    return all;
  }
  void apply(const Coordinates& rest, double fraction, Coordinates& out) const override {
    motion_.apply(rest, fraction, out);
    for (const auto& [node, leader, rotation] : followers_) {
      const Vec3 way = place_of(out, leader) - place_of(rest, leader);
      set_place(out, node, place_of(rest, node) + rotation * way);
    }
  }

 private:
  const Motion& motion_;
  std::vector<Follower> followers_;
  std::vector<Index> nodes_;
};

struct Link {
  Index other;
  Eigen::Matrix3d rotation;
  const PeriodicPairs* sides;
};

using Links = std::map<Index, std::vector<Link>>;

Links links_of(std::span<const PeriodicPairs> sides) {
  Links links;
  for (const PeriodicPairs& of : sides)
    for (const auto* list : {&of.pairs, &of.corners})
      for (const auto& [node, image] : *list) {
        links[node].push_back({image, of.image.rotation, &of});
        links[image].push_back({node, of.image.rotation.transpose(), &of});
      }
  return links;
}

/// Throws UsageError if the motion takes two nodes of a pair apart.
void require_images(const Motion& motion, const Coordinates& rest, const Links& links) {
  constexpr double share = 1e-6;
  Coordinates x = rest;
  for (const double fraction : {1.0, 0.5}) {
    motion.apply(rest, fraction, x);
    double longest = 0;
    for (const Index node : motion.nodes())
      longest = std::max(longest, (place_of(x, node) - place_of(rest, node)).norm());
    for (const Index node : motion.nodes()) {
      const auto found = links.find(node);
      if (found == links.end()) continue;
      const Vec3 way = place_of(x, node) - place_of(rest, node);
      for (const auto& [other, rotation, sides] : found->second) {
        if (!std::ranges::binary_search(motion.nodes(), other)) continue;
        const Vec3 of_other = place_of(x, other) - place_of(rest, other);
        if ((of_other - rotation * way).norm() <= share * longest) continue;
        throw UsageError("the motion takes nodes " + std::to_string(node) + " and " +
                         std::to_string(other) + ", which are periodic images of " + sides->first +
                         " and " + sides->second +
                         ", to places that are not: expected a motion that is the same on both "
                         "sides, or --fixed " +
                         sides->first + ", which gives up the pair");
      }
    }
  }
}

}  // namespace

std::unique_ptr<const Motion> with_images(const Motion& motion, const Coordinates& rest,
                                          std::span<const PeriodicPairs> sides) {
  const Links links = links_of(sides);
  if (links.empty()) return nullptr;
  require_images(motion, rest, links);
  struct Reached {
    Index leader;
    Eigen::Matrix3d rotation;
  };
  std::map<Index, Reached> reached;
  std::vector<Index> next(motion.nodes().begin(), motion.nodes().end());
  for (const Index node : next) reached[node] = {node, Eigen::Matrix3d::Identity()};
  std::vector<Follower> followers;
  for (std::size_t k = 0; k < next.size(); ++k) {
    const auto found = links.find(next[k]);
    if (found == links.end()) continue;
    const Reached from = reached[next[k]];
    for (const Link& link : found->second) {
      const Eigen::Matrix3d rotation = link.rotation * from.rotation;
      if (!reached.try_emplace(link.other, Reached{from.leader, rotation}).second) continue;
      followers.push_back({link.other, from.leader, rotation});
      next.push_back(link.other);
    }
  }
  if (followers.empty()) return nullptr;
  return std::make_unique<ImageMotion>(motion, std::move(followers));
}

}  // namespace winslow
