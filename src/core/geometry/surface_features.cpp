#include "core/geometry/surface_features.h"

#include <Eigen/Geometry>
#include <set>
#include <utility>

#include "core/geometry/surface/surface.h"
#include "core/mesh/index_sets.h"

namespace winslow {

namespace {

class Walk {
 public:
  Walk(const EdgeEnds& ends, const std::function<bool(Index)>& passes)
      : ends_(ends), passes_(passes) {}

  bool walked(Index a, Index b) const { return walked_.contains(std::minmax(a, b)); }

  Chain from(Index first, Index second) {
    Chain chain{{first}, false};
    Index before = first, node = second;
    for (;;) {
      walked_.insert(std::minmax(before, node));
      chain.nodes.push_back(node);
      if (node == first || !passes_(node)) return chain;
      const auto& around = ends_.at(node);
      const Index next = around[0] == before ? around[1] : around[0];
      before = std::exchange(node, next);
    }
  }

 private:
  const EdgeEnds& ends_;
  const std::function<bool(Index)>& passes_;
  std::set<std::pair<Index, Index>> walked_;
};

}  // namespace

std::vector<Chain> find_chains(const EdgeEnds& ends, const std::function<bool(Index)>& passes) {
  Walk walk(ends, passes);
  std::vector<Chain> chains;
  for (const auto& [node, around] : ends)
    if (!passes(node))
      for (const Index other : around)
        if (!walk.walked(node, other)) chains.push_back(walk.from(node, other));
  for (const auto& [node, around] : ends)
    if (passes(node) && !walk.walked(node, around[0]) && !walk.walked(node, around[1])) {
      Chain ring = walk.from(node, around[0]);
      ring.nodes.pop_back();
      ring.closed = true;
      chains.push_back(std::move(ring));
    }
  return chains;
}

namespace {

/// Finds feature edges and classifies the nodes.
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
    out_.regions = connected_faces(faces_.size(), edges_, sharp_);
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

  /// Finds tips: nodes without a feature edge where a face is inclined to the mean normal by more
  /// than the angle.
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

FeatureCurves curves_along(const SpacePoints& x, const SurfaceFeatures& features) {
  FeatureCurves out;
  out.tangents.assign(features.nodes.size(), Vec3(0, 0, 0));
  for (const Chain& line : features.lines) {
    std::vector<Vec3> points;
    for (const Index node : line.nodes) points.push_back(x[node]);
    constexpr std::size_t least_of_a_loop = 4;
    if (points.size() < 2 || (line.loop() && points.size() < least_of_a_loop)) {
      out.curves.push_back(nullptr);
      continue;
    }
    out.curves.push_back(curve_through(points, line.closed));
    for (const Index node : line.nodes)
      if (features.nodes[at(node)] == SurfaceNode::line)
        out.tangents[at(node)] = out.curves.back()->nearest(x[node]).tangent;
  }
  return out;
}

std::vector<std::vector<Index>> connected_faces(std::size_t face_count, const SurfaceEdges& edges,
                                                std::span<const unsigned char> cuts) {
  JoinedSets sets(face_count);
  for (std::size_t k = 0; k < cuts.size(); ++k)
    if (cuts[k] == 0) {
      const auto around = edges.faces[static_cast<Index>(k)];
      sets.join(around[0], around[1]);
    }
  std::map<Index, std::vector<Index>> by_lowest;
  for (Index f = 0; at(f) < face_count; ++f) by_lowest[sets.find(f)].push_back(f);
  std::vector<std::vector<Index>> groups;
  for (auto& [lowest, faces] : by_lowest) groups.push_back(std::move(faces));
  return groups;
}

std::vector<Index> nodes_of_faces(std::span<const SurfaceFace> faces,
                                  std::span<const Index> chosen) {
  std::vector<Index> nodes;
  for (const Index f : chosen)
    nodes.insert(nodes.end(), faces[at(f)].nodes.begin(), faces[at(f)].nodes.end());
  sort_unique(nodes);
  return nodes;
}

Triangulation triangulated(const SpacePoints& x, std::span<const SurfaceFace> faces,
                           std::span<const Index> chosen, std::span<const Index> nodes) {
  Triangulation surface;
  for (const Index node : nodes) surface.points.push_back(x[node]);
  for (const Index f : chosen) {
    const Face& face = faces[at(f)].nodes;
    const auto corner = [&](Index k) {
      return static_cast<Index>(std::ranges::lower_bound(nodes, face[at(k)]) - nodes.begin());
    };
    for (const auto& [a, b, c] : triangles_of(x, std::span(face.begin(), face.end())))
      surface.triangles.push_back({corner(a), corner(b), corner(c)});
  }
  return surface;
}

std::shared_ptr<const Surface> surface_over(const SpacePoints& x,
                                            std::span<const SurfaceFace> faces,
                                            std::span<const Index> chosen,
                                            const FeatureCurves& curves) {
  const std::vector<Index> nodes = nodes_of_faces(faces, chosen);
  std::vector<Vec3> tangents;
  for (const Index node : nodes) tangents.push_back(curves.tangents[at(node)]);
  return surface_through(triangulated(x, faces, chosen, nodes), tangents);
}

}  // namespace winslow
