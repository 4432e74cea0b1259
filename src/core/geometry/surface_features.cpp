#include "core/geometry/surface_features.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "core/mesh/joined_sets.h"

namespace winslow {

namespace {

/// The edges of a surface that are features, and what they make of its nodes.
class FeatureFinder {
 public:
  FeatureFinder(const Coordinates& x, std::span<const SurfaceFace> faces, double angle,
                std::span<const Index> smooth)
      : x_(x),
        node_count_(x.size()),
        faces_(faces),
        edges_(surface_edges(faces)),
        sharp_(feature_edges(x_, faces, edges_, angle)),
        least_cosine_(std::cos(radians(angle))),
        smooth_(smooth.begin(), smooth.end()) {}

  SurfaceFeatures find() {
    find_regions();
    for (std::size_t k = 0; k < sharp_.size(); ++k) {
      if (sharp_[k] == 0) continue;
      const auto [a, b] = edges_.nodes[k];
      ends_[a].push_back(b);
      ends_[b].push_back(a);
    }
    classify();
    out_.lines =
        find_chains(ends_, [&](Index node) { return out_.nodes[at(node)] == SurfaceNode::line; });
    return std::move(out_);
  }

 private:
  void find_regions() {
    JoinedSets sets(faces_.size());
    for (std::size_t k = 0; k < sharp_.size(); ++k)
      if (sharp_[k] == 0) {
        const auto around = edges_.faces[static_cast<Index>(k)];
        sets.join(around[0], around[1]);
      }
    std::map<Index, Index> numbers;
    for (std::size_t f = 0; f < faces_.size(); ++f) {
      const auto [place, is_new] =
          numbers.try_emplace(sets.find(static_cast<Index>(f)), out_.regions);
      if (is_new) ++out_.regions;
      out_.region.push_back(place->second);
    }
  }

  void classify() {
    out_.nodes.assign(at(node_count_), SurfaceNode::none);
    for (const SurfaceFace& face : faces_)
      for (const Index node : face.nodes) out_.nodes[at(node)] = SurfaceNode::inside;
    for (const auto& [node, others] : ends_) {
      const bool on = runs_on(node, others);
      out_.nodes[at(node)] = on ? SurfaceNode::line : SurfaceNode::corner;
      if (!on && others.size() == 2) out_.bends.push_back(node);
    }
    find_tips();
  }

  bool runs_on(Index node, const std::vector<Index>& others) const {
    if (others.size() != 2) return false;
    if (smooth_.contains(node)) return true;
    const Vec3 in = x_[node] - x_[others[0]], out = x_[others[1]] - x_[node];
    return in.dot(out) >= least_cosine_ * in.norm() * out.norm();
  }

  /// Nodes around which no edge is sharp, and the faces lean away from their mean all the same.
  void find_tips() {
    std::vector<Vec3> normals(at(node_count_), Vec3(0, 0, 0));
    for (const SurfaceFace& face : faces_) {
      const Vec3 area = area_vector(x_, face.nodes);
      if (area.norm() > 0)
        for (const Index node : face.nodes) normals[at(node)] += area.normalized();
    }
    for (const SurfaceFace& face : faces_) {
      const Vec3 area = area_vector(x_, face.nodes);
      for (const Index node : face.nodes)
        if (out_.nodes[at(node)] == SurfaceNode::inside && !smooth_.contains(node) &&
            area.dot(normals[at(node)]) < least_cosine_ * area.norm() * normals[at(node)].norm()) {
          out_.nodes[at(node)] = SurfaceNode::corner;
          out_.tips.push_back(node);
        }
    }
    std::ranges::sort(out_.tips);
  }

  SpacePoints x_;
  Index node_count_;
  std::span<const SurfaceFace> faces_;
  SurfaceEdges edges_;
  std::vector<unsigned char> sharp_;
  double least_cosine_;
  std::set<Index> smooth_;
  EdgeEnds ends_;
  SurfaceFeatures out_;
};

}  // namespace

SurfaceFeatures find_features(const Coordinates& x, std::span<const SurfaceFace> faces,
                              double angle, std::span<const Index> smooth) {
  return FeatureFinder(x, faces, angle, smooth).find();
}

}  // namespace winslow
