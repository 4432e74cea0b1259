#include <algorithm>
#include <cmath>
#include <map>
#include <set>
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
  ChainFinder(const Topology& topology, const Coordinates& x, Index marker,
              const FeatureRules& rules)
      : x_(x),
        feature_angle_(radians(rules.angle)),
        smooth_(rules.smooth.begin(), rules.smooth.end()) {
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

  bool has(Index node) const { return next_.contains(node); }
  /// Whether the marker alone goes through a node, turning or not.
  bool runs_on(Index node) const {
    if (next_.at(node).size() != 2 || others_.contains(node)) return false;
    const auto edges = edges_at_.find(node);  // none of a marker inside the mesh
    return edges == edges_at_.end() || edges->second == 2;
  }
  /// Whether the marker runs on through a node, without a feature.
  bool passes(Index node) const {
    if (!runs_on(node)) return false;
    if (smooth_.contains(node)) return true;
    const auto& neighbours = next_.at(node);
    const Vec2 in = x_.xy(node) - x_.xy(neighbours[0]), out = x_.xy(neighbours[1]) - x_.xy(node);
    const double turn = std::atan2(in.x() * out.y() - in.y() * out.x(), in.dot(out));
    return std::abs(turn) <= feature_angle_;
  }

 private:
  const Coordinates& x_;
  double feature_angle_;
  std::set<Index> smooth_;
  EdgeEnds next_;
  std::map<Index, int> others_, edges_at_;
};

/// Smooth nodes of the rules: found by the markers that slide.
class SmoothNodes {
 public:
  explicit SmoothNodes(const FeatureRules& rules)
      : left_(rules.smooth.begin(), rules.smooth.end()) {}

  /// Throws UsageError for one at which the marker does not run on.
  void look_at(const ChainFinder& finder, const std::string& marker) {
    std::erase_if(left_, [&](Index node) {
      if (!finder.has(node)) return false;
      if (!finder.runs_on(node))
        throw UsageError("node " + std::to_string(node) + " cannot be smooth: marker \"" + marker +
                         "\" ends or branches there, or meets another marker");
      return true;
    });
  }
  /// Throws UsageError for one that none of the markers has.
  void require_none_left() const {
    if (!left_.empty())
      throw UsageError("node " + std::to_string(*left_.begin()) +
                       " cannot be smooth: no marker that slides has it");
  }

 private:
  std::set<Index> left_;
};

}  // namespace

SlidingBoundary sliding_on_curves(const Topology& topology, const Coordinates& x,
                                  std::span<const Index> markers, const FeatureRules& rules) {
  SmoothNodes smooth(rules);
  SlidingBoundary boundary;
  auto geometry = std::make_shared<CurveGeometry>();
  for (const Index marker : markers) {
    ChainFinder finder(topology, x, marker, rules);
    smooth.look_at(finder, topology.markers()[static_cast<std::size_t>(marker)].name);
    for (const Chain& chain : finder.find()) {
      SlidingPart part{topology.markers()[static_cast<std::size_t>(marker)].name, {}, {}};
      for (const Index node : chain.nodes)
        if (chain.closed || finder.passes(node))
          part.nodes.push_back(node);
        else if (finder.runs_on(node))
          boundary.bends.push_back(node);
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
  smooth.require_none_left();
  std::ranges::sort(boundary.bends);  // the ends of two chains each
  boundary.bends.erase(std::unique(boundary.bends.begin(), boundary.bends.end()),
                       boundary.bends.end());
  boundary.geometry = std::move(geometry);
  return boundary;
}

}  // namespace winslow
