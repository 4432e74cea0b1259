#include "core/geometry/boundary_kinds.h"

#include <set>
#include <utility>

#include "core/geometry/curve.h"
#include "core/mesh/coordinates.h"

namespace winslow {

CornerMarkers::CornerMarkers(const Topology& topology, std::span<const Index> sliding)
    : topology_(topology), sliding_(sliding.begin(), sliding.end()) {
  const auto& markers = topology.markers();
  for (Index m = 0; m < static_cast<Index>(markers.size()); ++m)
    for (const Index node : markers.nodes(m)) markers_at_[node].push_back(m);
  std::erase_if(markers_at_, [](const auto& entry) { return entry.second.size() < 2; });
}

bool CornerMarkers::meets_sliding(Index node) const {
  const auto found = markers_at_.find(node);
  return found != markers_at_.end() && std::ranges::any_of(found->second, [&](Index m) {
           return std::ranges::find(sliding_, m) != sliding_.end();
         });
}

void CornerMarkers::require_both(const Coordinates& x, const PeriodicPair& pair) const {
  const bool first = meets_sliding(pair.node);
  if (first == meets_sliding(pair.image)) return;
  const Index there = first ? pair.node : pair.image;
  std::string name;
  for (const Index m : markers_at_.at(there))
    if (std::ranges::find(sliding_, m) != sliding_.end()) name = topology_.markers()[at(m)].name;
  refuse_corner(x, there, first ? pair.image : pair.node, name,
                "is on none that does: expected both to slide, or neither");
}

std::optional<Index> CornerMarkers::sliding_at(Index node, const PeriodicPairs& pairs) const {
  const auto found = markers_at_.find(node);
  if (found == markers_at_.end()) return std::nullopt;
  std::optional<Index> only;
  for (const Index m : found->second) {
    const std::string& name = topology_.markers()[at(m)].name;
    if (name == pairs.first || name == pairs.second) continue;
    if (only || std::ranges::find(sliding_, m) == sliding_.end()) return std::nullopt;
    only = m;
  }
  return only;
}

void refuse_corner(const Coordinates& x, Index on_sliding, Index partner, const std::string& marker,
                   const std::string& what) {
  const auto place = [&](Index node) {
    return "node " + std::to_string(node) + " at " +
           (x.dimension() == 2 ? place_text(Vec2(x.xy(node))) : place_text(Vec3(x.xyz(node))));
  };
  throw UsageError(place(on_sliding) + ", at the end of a periodic side, is on \"" + marker +
                   "\", which slides, and its image, " + place(partner) + ", " + what);
}

namespace {

Vec3 lifted(const Vec2& v) { return {v.x(), v.y(), 0}; }

double turn_between(const Vec2& in, const Vec2& out) {
  return std::atan2(in.x() * out.y() - in.y() * out.x(), in.dot(out));
}

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
  void add(std::shared_ptr<const PlaneCurve> curve, std::span<const Index> nodes) {
    for (const Index node : nodes) parts_.set(node, static_cast<Index>(curves_.size()));
    curves_.push_back(std::move(curve));
  }

 private:
  std::vector<std::shared_ptr<const PlaneCurve>> curves_;
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
    return std::abs(turn_between(in, out)) <= feature_angle_;
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

/// A stretch of a sliding marker, and what it goes on as where periodic corners end it.
struct Stretch {
  Index marker;
  Chain chain;
  std::vector<Index> passing;  // nodes that it runs on through
  std::vector<Vec2> before = {}, after = {};
};

class StretchFinder {
 public:
  StretchFinder(const Topology& topology, const Coordinates& x, std::span<const Index> markers,
                const FeatureRules& rules)
      : x_(x), feature_angle_(radians(rules.angle)), at_corners_(topology, markers) {
    SmoothNodes smooth(rules);
    for (const Index marker : markers) {
      const ChainFinder finder(topology, x, marker, rules);
      smooth.look_at(finder, topology.markers()[at(marker)].name);
      for (Chain& chain : finder.find()) {
        std::vector<Index> passing;
        for (const Index node : chain.nodes)
          if (chain.closed || finder.passes(node))
            passing.push_back(node);
          else if (finder.runs_on(node))
            bends_.push_back(node);
        // A row from a feature round to itself repeats its first place.
        if (chain.loop() && chain.nodes.size() < 4) continue;
        if (!chain.closed && !chain.loop()) {
          ends_[chain.nodes.front()].push_back({stretches_.size(), true});
          ends_[chain.nodes.back()].push_back({stretches_.size(), false});
        }
        stretches_.push_back({marker, std::move(chain), std::move(passing)});
      }
    }
    smooth.require_none_left();
    std::ranges::sort(bends_);  // the ends of two chains each
    bends_.erase(std::unique(bends_.begin(), bends_.end()), bends_.end());
  }

  /// Has the stretches go on beyond the corners that slide, which it returns.
  std::vector<PeriodicPair> join(std::span<const PeriodicPairs> periodic) {
    std::vector<PeriodicPair> sliding;
    for (const PeriodicPairs& pairs : periodic) {
      if (pairs.halo) continue;
      for (const PeriodicPair& pair : pairs.corners)
        if (joins(pair, pairs)) sliding.push_back(pair);
    }
    return sliding;
  }

  std::vector<Stretch>& stretches() { return stretches_; }
  /// Nodes that end a stretch because of the feature angle alone, ascending.
  const std::vector<Index>& bends() const { return bends_; }

 private:
  struct End {
    std::size_t stretch;
    bool front;
  };

  bool joins(const PeriodicPair& pair, const PeriodicPairs& pairs) {
    at_corners_.require_both(x_, pair);
    if (!at_corners_.sliding_at(pair.node, pairs) || !at_corners_.sliding_at(pair.image, pairs))
      return false;
    const auto first = ends_.find(pair.node), second = ends_.find(pair.image);
    if (first == ends_.end() || second == ends_.end() || first->second.size() != 1 ||
        second->second.size() != 1)
      return false;
    const End here = first->second.front(), there = second->second.front();
    const Eigen::Matrix2d r = pairs.image.rotation.topLeftCorner<2, 2>();
    const Vec2 c = pairs.image.offset.head<2>();
    const std::vector<Vec2> from_node = inward(here), from_image = inward(there);
    // The way that comes to the node from inside the mesh, and goes on behind its image.
    const Vec2 in = from_node[0] - from_node[1];
    const Vec2 out = r.transpose() * (from_image[1] - from_image[0]);
    if (std::abs(turn_between(in, out)) > feature_angle_) return false;
    for (std::size_t k = 1; k < from_image.size(); ++k)
      beyond(here).push_back(r.transpose() * (from_image[k] - c));
    for (std::size_t k = 1; k < from_node.size(); ++k)
      beyond(there).push_back(r * from_node[k] + c);
    return true;
  }

  std::vector<Vec2>& beyond(const End& end) {
    return end.front ? stretches_[end.stretch].before : stretches_[end.stretch].after;
  }

  /// The places of a stretch from one of its ends on.
  std::vector<Vec2> inward(const End& end) const {
    std::vector<Vec2> places;
    for (const Index node : stretches_[end.stretch].chain.nodes) places.push_back(x_.xy(node));
    if (!end.front) std::ranges::reverse(places);
    return places;
  }

  const Coordinates& x_;
  double feature_angle_;
  CornerMarkers at_corners_;
  std::vector<Stretch> stretches_;
  std::vector<Index> bends_;
  std::map<Index, std::vector<End>> ends_;
};

}  // namespace

SlidingBoundary sliding_on_curves(const Topology& topology, const Coordinates& x,
                                  std::span<const Index> markers, const FeatureRules& rules,
                                  std::span<const PeriodicPairs> periodic) {
  SlidingBoundary boundary;
  auto geometry = std::make_shared<CurveGeometry>();
  StretchFinder finder(topology, x, markers, rules);
  boundary.corners = finder.join(periodic);
  boundary.bends = finder.bends();
  for (const Stretch& stretch : finder.stretches()) {
    const Chain& chain = stretch.chain;
    SlidingPart part{topology.markers()[at(stretch.marker)].name, {}, stretch.passing};
    for (const PeriodicPair& corner : boundary.corners)
      if (!chain.closed &&
          (corner.node == chain.nodes.front() || corner.node == chain.nodes.back()))
        part.nodes.push_back(corner.node);
    if (part.nodes.empty()) continue;
    std::vector<Vec2> points(stretch.before.rbegin(), stretch.before.rend());
    std::vector<Vec3> places;
    for (const Index node : chain.nodes) {
      points.push_back(x.xy(node));
      places.push_back(lifted(x.xy(node)));
    }
    points.insert(points.end(), stretch.after.begin(), stretch.after.end());
    const std::shared_ptr<const PlaneCurve> curve = curve_through(points, chain.closed);
    part.description = curve->description();
    part.row = std::make_shared<const CurveRow>(chain.nodes, chain.closed, by_arc(curve), places);
    geometry->add(curve, part.nodes);
    boundary.parts.push_back(std::move(part));
  }
  boundary.geometry = std::move(geometry);
  return boundary;
}

}  // namespace winslow
