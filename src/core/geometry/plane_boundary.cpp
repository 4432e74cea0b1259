#include <cmath>
#include <map>
#include <utility>

#include "core/geometry/boundary_kinds.h"
#include "core/geometry/chains.h"
#include "core/geometry/curve.h"

namespace winslow {

namespace {

Vec3 lifted(const Vec2& v) { return {v.x(), v.y(), 0}; }

class CurveGeometry final : public SlidingGeometry {
 public:
  Foot foot(Index node, const Vec3& point) const override {
    const CurvePoint<2> place =
        curves_[static_cast<std::size_t>(parts_.of(node))]->nearest(point.head<2>());
    Foot foot;
    foot.point = lifted(place.point);
    foot.frame.add(lifted(place.tangent));
    foot.bend[0] = lifted(place.curvature);
    return foot;
  }
  void add(std::unique_ptr<const PlaneCurve> curve, std::span<const Index> nodes) {
    for (const Index node : nodes) parts_.set(node, static_cast<Index>(curves_.size()));
    curves_.push_back(std::move(curve));
  }

 private:
  std::vector<std::unique_ptr<const PlaneCurve>> curves_;
  NodeParts parts_;
};

/// The edges of one marker as rows of nodes between features.
class ChainFinder {
 public:
  ChainFinder(const Topology& topology, const Coordinates& x, Index marker, double feature_angle)
      : x_(x), feature_angle_(radians(feature_angle)) {
    const auto& markers = topology.markers();
    for (const Face& face : markers[static_cast<std::size_t>(marker)].faces) {
      const auto [a, b] = face.edge();
      next_[a].push_back(b);
      next_[b].push_back(a);
    }
    for (Index other = 0; other < static_cast<Index>(markers.size()); ++other)
      if (other != marker)
        for (const Index node : markers.nodes(other)) ++others_[node];
    for (const auto& edge : topology.edges())
      if (edge.elements[1] < 0)
        for (const Index node : edge.nodes) ++edges_at_[node];
  }

  std::vector<Chain> find() const {
    return find_chains(next_, [this](Index node) { return passes(node); });
  }

  /// Whether the marker runs on through a node, without a feature.
  bool passes(Index node) const {
    const auto& neighbours = next_.at(node);
    if (neighbours.size() != 2 || others_.contains(node)) return false;
    const auto edges = edges_at_.find(node);  // none of a marker inside the mesh
    if (edges != edges_at_.end() && edges->second != 2) return false;
    const Vec2 in = x_.xy(node) - x_.xy(neighbours[0]), out = x_.xy(neighbours[1]) - x_.xy(node);
    const double turn = std::atan2(in.x() * out.y() - in.y() * out.x(), in.dot(out));
    return std::abs(turn) <= feature_angle_;
  }

 private:
  const Coordinates& x_;
  double feature_angle_;
  EdgeEnds next_;
  std::map<Index, int> others_, edges_at_;
};

}  // namespace

SlidingBoundary sliding_on_curves(const Topology& topology, const Coordinates& x,
                                  std::span<const Index> markers, double feature_angle) {
  SlidingBoundary boundary;
  auto geometry = std::make_shared<CurveGeometry>();
  for (const Index marker : markers) {
    ChainFinder finder(topology, x, marker, feature_angle);
    for (const Chain& chain : finder.find()) {
      SlidingPart part{topology.markers()[static_cast<std::size_t>(marker)].name, {}, {}};
      for (const Index node : chain.nodes)
        if (chain.closed || finder.passes(node)) part.nodes.push_back(node);
      if (part.nodes.empty()) continue;
      std::vector<Vec2> points;
      for (const Index node : chain.nodes) points.push_back(x.xy(node));
      // A row from a feature round to itself repeats its first place.
      if (chain.loop() && points.size() < 4) continue;
      auto curve = curve_through(points, chain.closed);
      part.description = curve->description();
      geometry->add(std::move(curve), part.nodes);
      boundary.parts.push_back(std::move(part));
    }
  }
  boundary.geometry = std::move(geometry);
  return boundary;
}

}  // namespace winslow
