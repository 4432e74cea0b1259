#include "core/geometry/sliding_boundary.h"

#include <set>
#include <utility>

#include "core/error.h"
#include "core/geometry/boundary_kinds.h"

namespace winslow {

TangentFrame TangentFrame::axes(int dimension) {
  TangentFrame frame;
  for (int k = 0; k < dimension; ++k) frame.add(Vec3::Unit(k));
  return frame;
}

Foot RememberedFeet::foot(Index node, const Vec3& point) const {
  Memory& memory = memory_[at(node)];
  for (std::size_t k = 0; k < memory.places.size(); ++k) {
    const Place& place = memory.places[k];
    if (!place.known || (place.asked_for != point && place.foot.point != point)) continue;
    memory.last = k;
    return place.foot;
  }
  memory.last = 1 - memory.last;
  Place& place = memory.places[memory.last];
  place = {point, geometry_->foot(node, point), true};
  return place.foot;
}

namespace {

void require_nodes(const Topology& topology, std::span<const Index> nodes) {
  for (const Index node : nodes)
    if (node < 0 || node >= topology.node_count())
      throw UsageError("found node " + std::to_string(node) + " to hold or to make smooth, " +
                       "expected 0 to " + std::to_string(topology.node_count() - 1));
}

/// The interfaces of a mesh as markers.
std::vector<Marker> interface_markers(const Topology& topology) {
  std::vector<Marker> markers;
  for (const RegionInterface& meeting : topology.interfaces())
    markers.push_back({topology.name_of(meeting), 0, meeting.faces});
  return markers;
}

/// The nodes that stay: those of the rules, and in a surface mesh those in which regions meet.
std::vector<Index> held_nodes(const Topology& topology, const FeatureRules& rules) {
  std::vector<Index> nodes = rules.hold;
  if (is_surface(topology) &&
      (rules.interfaces == Interfaces::held || rules.interfaces == Interfaces::automatic))
    for (const RegionInterface& meeting : topology.interfaces())
      nodes.insert(nodes.end(), meeting.nodes.begin(), meeting.nodes.end());
  return nodes;
}

/// Only nodes inside a mesh slide where regions meet: those of its boundary stay.
void keep_inside(const Topology& topology, SlidingBoundary& boundary) {
  if (is_surface(topology)) return;
  for (SlidingPart& part : boundary.parts)
    if (part.of_regions)
      std::erase_if(part.nodes, [&](Index node) { return topology.on_boundary(node); });
  std::erase_if(boundary.parts, [](const SlidingPart& part) { return part.nodes.empty(); });
}

/// Removes held nodes from the nodes that slide. The curves and surfaces still run through them.
void remove_held(SlidingBoundary& boundary, std::vector<Index> nodes) {
  std::ranges::sort(nodes);
  for (SlidingPart& part : boundary.parts)
    std::erase_if(part.nodes, [&](Index node) { return std::ranges::binary_search(nodes, node); });
  std::erase_if(boundary.parts, [](const SlidingPart& part) { return part.nodes.empty(); });
  for (const Index node : nodes) boundary.places.erase(node);
}

}  // namespace

std::vector<Index> marker_indices(const Topology& topology, std::span<const std::string> names) {
  topology.markers().nodes_of(names);  // throws for unknown markers
  std::vector<Index> indices;
  for (const std::string& name : names) indices.push_back(*topology.markers().find(name));
  return indices;
}

SlidingMarkers::SlidingMarkers(const Topology& topology, std::vector<Index> markers,
                               Interfaces interfaces)
    : all(interfaces == Interfaces::free || is_surface(topology)
              ? topology.markers()
              : topology.markers().with(interface_markers(topology))),
      sliding(std::move(markers)),
      of_mesh(static_cast<Index>(topology.markers().size())),
      along_regions(is_surface(topology) && interfaces == Interfaces::slide &&
                    !topology.interfaces().empty()) {
  if (interfaces != Interfaces::slide) return;
  for (Index m = of_mesh; m < static_cast<Index>(all.size()); ++m) sliding.push_back(m);
}

std::string text_of(Spacing spacing) {
  switch (spacing) {
    case Spacing::turns:
      return ", spacing held: turns as a whole";
    case Spacing::ends:
      return ", spacing held: follows its ends";
    case Spacing::stays:
      return ", spacing held: stays between its ends";
    case Spacing::free:
      break;
  }
  return {};
}

SlidingBoundary SlidingBoundary::find(const Topology& topology, const Coordinates& x,
                                      std::span<const std::string> names, const FeatureRules& rules,
                                      const ReferenceSurface* reference,
                                      std::span<const PeriodicPairs> periodic) {
  require_nodes(topology, rules.hold);
  require_nodes(topology, rules.smooth);
  if (is_surface(topology) && !names.empty())
    throw UsageError("all nodes of a surface mesh slide: expected no marker, found \"" +
                     names.front() + "\"");
  const SlidingMarkers markers(topology, marker_indices(topology, names), rules.interfaces);
  const bool plane = topology.kind() == MeshKind::plane;
  if (plane && reference)
    throw UsageError(reference->source + ": a reference surface is for meshes in space, and this " +
                     "is a plane mesh");
  SlidingBoundary boundary = plane ? sliding_on_curves(topology, x, markers, rules, periodic)
                             : reference
                                 ? sliding_on_reference(topology, x, markers, rules, *reference)
                                 : sliding_on_surfaces(topology, x, markers, rules, periodic);
  for (const std::string& name : names) {
    bool slides = false;
    for (const SlidingPart& part : boundary.parts) slides |= part.marker == name;
    if (!slides)
      throw UsageError("no node of marker \"" + name +
                       "\" can slide: each lies at a corner or meets another marker");
  }
  keep_inside(topology, boundary);
  remove_held(boundary, held_nodes(topology, rules));
  return boundary;
}

Coordinates put_on(const SlidingBoundary& boundary, Coordinates x) {
  for (const SlidingPart& part : boundary.parts)
    for (const Index node : part.nodes)
      x.set_place(node, boundary.geometry->foot(node, place_of(x, node)).point);
  for (const auto& [node, place] : boundary.places) x.set_xyz(node, place);
  return x;
}

CornerMarkers::CornerMarkers(const SlidingMarkers& markers) : markers_(markers) {
  for (Index m = 0; m < static_cast<Index>(markers.all.size()); ++m)
    for (const Index node : markers.all.nodes(m)) markers_at_[node].push_back(m);
  std::erase_if(markers_at_, [](const auto& entry) { return entry.second.size() < 2; });
}

bool CornerMarkers::meets_sliding(Index node) const {
  const auto found = markers_at_.find(node);
  return found != markers_at_.end() &&
         std::ranges::any_of(found->second, [&](Index m) { return markers_.slides(m); });
}

void CornerMarkers::require_both(const Coordinates& x, const PeriodicPair& pair) const {
  const bool first = meets_sliding(pair.node);
  if (first == meets_sliding(pair.image)) return;
  const Index there = first ? pair.node : pair.image;
  std::string name;
  for (const Index m : markers_at_.at(there))
    if (markers_.slides(m)) name = markers_.name(m);
  refuse_corner(x, there, first ? pair.image : pair.node, name,
                "is on none that does: expected both to slide, or neither");
}

std::optional<Index> CornerMarkers::sliding_at(Index node, const PeriodicPairs& pairs) const {
  const auto found = markers_at_.find(node);
  if (found == markers_at_.end()) return std::nullopt;
  std::optional<Index> only;
  for (const Index m : found->second) {
    const std::string& name = markers_.name(m);
    if (name == pairs.first || name == pairs.second) continue;
    if (only || !markers_.slides(m)) return std::nullopt;
    only = m;
  }
  return only;
}

void refuse_corner(const Coordinates& x, Index on_sliding, Index partner, const std::string& marker,
                   const std::string& what) {
  const auto place = [&](Index node) {
    return "node " + std::to_string(node) + " at " + place_text(place_of(x, node), x.dimension());
  };
  throw UsageError(place(on_sliding) + ", at the end of a periodic side, is on \"" + marker +
                   "\", which slides, and its image, " + place(partner) + ", " + what);
}

namespace {

/// Cuts one marker of a plane mesh at its features into chains of nodes.
class ChainFinder {
 public:
  ChainFinder(const Topology& topology, const Markers& markers, const Coordinates& x, Index marker,
              const FeatureRules& rules)
      : x_(x),
        feature_angle_(radians(rules.angle)),
        smooth_(rules.smooth.begin(), rules.smooth.end()) {
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

  /// Removes the nodes of the marker from smooth nodes. Throws UsageError for one at which the
  /// marker ends, branches or meets another one.
  void check_smooth(std::set<Index>& nodes, const std::string& marker) const {
    std::erase_if(nodes, [&](Index node) {
      if (!next_.contains(node)) return false;
      if (!runs_on(node))
        throw UsageError("node " + std::to_string(node) + " cannot be smooth: marker \"" + marker +
                         "\" ends or branches there, or meets another marker");
      return true;
    });
  }
  /// Whether a node has two edges of the marker and no other marker or boundary.
  bool runs_on(Index node) const {
    if (next_.at(node).size() != 2 || others_.contains(node)) return false;
    const auto edges = edges_at_.find(node);  // no boundary edges for a marker inside the mesh
    return edges == edges_at_.end() || edges->second == 2;
  }
  /// Whether a node is not a feature.
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

/// A chain of a sliding marker, with the points of its periodic continuation beyond its ends.
struct Stretch {
  Index marker;
  Chain chain;
  std::vector<Index> passing;  // nodes that are no features
  std::vector<Vec2> before = {}, after = {};
};

class StretchFinder {
 public:
  StretchFinder(const Topology& topology, const Coordinates& x, const SlidingMarkers& markers,
                const FeatureRules& rules)
      : x_(x), feature_angle_(radians(rules.angle)), at_corners_(markers) {
    std::set<Index> smooth(rules.smooth.begin(), rules.smooth.end());
    for (const Index marker : markers.sliding) {
      const ChainFinder finder(topology, markers.all, x, marker, rules);
      finder.check_smooth(smooth, markers.name(marker));
      for (Chain& chain : finder.find()) {
        std::vector<Index> passing;
        for (const Index node : chain.nodes)
          if (chain.closed || finder.passes(node))
            passing.push_back(node);
          else if (finder.runs_on(node))
            bends_.push_back(node);
        // A loop from a feature to itself repeats its first node.
        if (chain.loop() && chain.nodes.size() < 4) continue;
        if (!chain.closed && !chain.loop()) {
          ends_[chain.nodes.front()].push_back({stretches_.size(), true});
          ends_[chain.nodes.back()].push_back({stretches_.size(), false});
        }
        stretches_.push_back({marker, std::move(chain), std::move(passing)});
      }
    }
    if (!smooth.empty())
      throw UsageError("node " + std::to_string(*smooth.begin()) +
                       " cannot be smooth: no marker that slides has it");
    sort_unique(bends_);  // each is the end of two chains
  }

  /// Continues the stretches beyond the corners that slide; returns these corners.
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
    // Directions of the edge that ends at the node and of its continuation beyond the image.
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

  /// The positions of a stretch from one of its ends inwards.
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
                                  const SlidingMarkers& markers, const FeatureRules& rules,
                                  std::span<const PeriodicPairs> periodic) {
  SlidingBoundary boundary;
  auto geometry = std::make_shared<SpaceGeometry>();
  StretchFinder finder(topology, x, markers, rules);
  boundary.corners = finder.join(periodic);
  boundary.bends = finder.bends();
  for (const Stretch& stretch : finder.stretches()) {
    const Chain& chain = stretch.chain;
    SlidingPart part{markers.name(stretch.marker), {}, stretch.passing};
    part.of_regions = markers.of_regions(stretch.marker);
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
    const std::shared_ptr<const SpaceCurve> curve = lifted(curve_through(points, chain.closed));
    part.description = curve->description();
    part.goes_on = curve->goes_on();
    part.row = std::make_shared<const CurveRow>(chain.nodes, chain.closed, curve, places);
    geometry->add(curve, part.nodes);
    boundary.parts.push_back(std::move(part));
  }
  boundary.geometry = std::move(geometry);
  return boundary;
}

}  // namespace winslow
