#include <utility>

#include "core/error.h"
#include "core/geometry/boundary_kinds.h"
#include "core/geometry/reference_shape.h"
#include "core/mesh/coordinates.h"
#include "core/mesh/index_sets.h"
#include "core/options/option.h"

namespace winslow {

namespace {

/// Finds the curves and surfaces of a reference surface for the nodes of sliding faces.
class ReferenceFinder {
 public:
  ReferenceFinder(const Topology& topology, const Coordinates& x, const SlidingMarkers& markers,
                  const FeatureRules& rules, const ReferenceSurface& reference)
      : topology_(topology),
        markers_(markers),
        x_(x),
        sliding_(sliding_faces(topology, markers)),
        edges_(surface_edges(sliding_.faces)),
        shape_(reference, rules.angle),
        smooth_(rules.smooth.begin(), rules.smooth.end()) {
    // With an angle of 180 degrees, only borders, edges between markers and edges of more than two
    // faces are features.
    const auto kept = feature_edges(x_, sliding_.faces, edges_, 180);
    const ReferenceLines match(x_, sliding_.faces, edges_, topology.node_count(), shape_,
                               rules.angle);
    line_of_edge_ = match.lines();
    shortest_ = match.shortest();
    corners_ = match.corners();
    if (rules.slide_along) fading_ = match.fading();
    cut_.resize(kept.size());
    for (std::size_t k = 0; k < kept.size(); ++k)
      cut_[k] = kept[k] != 0 || line_of_edge_[k] >= 0 ? 1 : 0;
    classify(std::cos(radians(rules.angle)));
    hold_corners();
    require_smooth(rules, nodes_, sliding_.stays);
    Box<3> box = Box<3>::empty();
    for (const SurfaceFace& face : sliding_.faces)
      for (const Index corner : face.nodes) box.add(x_[corner]);
    extent_ = box.size().norm();
  }

  SlidingBoundary boundary(bool features) {
    for (const auto& region : connected_faces(sliding_.faces.size(), edges_, cut_))
      add_region(region);
    if (features) {
      add_curves();
      out_.bends = bends_;
      for (const auto& [node, place] : corners_)
        if (nodes_[at(node)] == SurfaceNode::corner && sliding_.stays[at(node)] == 0)
          out_.places.emplace(node, place);
    }
    out_.geometry = geometry_;
    return std::move(out_);
  }

 private:
  /// The cut edges at a node.
  struct NodeEdges {
    std::vector<Index> others;
    Index line = -1;  ///< line of the last cut edge; -1: none
    bool one_line = true;
  };

  void classify(double least_cosine) {
    nodes_.assign(at(topology_.node_count()), SurfaceNode::none);
    for (const SurfaceFace& face : sliding_.faces)
      for (const Index node : face.nodes) nodes_[at(node)] = SurfaceNode::inside;
    std::map<Index, NodeEdges> around;
    for (std::size_t k = 0; k < cut_.size(); ++k) {
      if (cut_[k] == 0) continue;
      const auto [a, b] = edges_.nodes[k];
      for (const auto& [node, other] : {std::pair(a, b), std::pair(b, a)}) {
        NodeEdges& of = around[node];
        of.one_line &= of.others.empty() || of.line == line_of_edge_[k];
        of.line = line_of_edge_[k];
        of.others.push_back(other);
      }
    }
    line_of_node_.assign(nodes_.size(), -1);
    for (const auto& [node, of] : around) {
      bool runs_on = of.one_line && of.line >= 0 && of.others.size() == 2;
      if (runs_on && !smooth_.contains(node)) {
        const auto on_line = [&, line = of.line](Index i) {
          return shape_.foot_on_line(line, x_[i]).point;
        };
        const Vec3 in = on_line(node) - on_line(of.others[0]);
        const Vec3 out = on_line(of.others[1]) - on_line(node);
        runs_on = in.dot(out) >= least_cosine * in.norm() * out.norm();
        if (!runs_on && sliding_.stays[at(node)] == 0) bends_.push_back(node);
      }
      const bool fades = of.others.size() == 1 && fading_.contains(node);
      nodes_[at(node)] = runs_on ? SurfaceNode::line
                         : fades ? SurfaceNode::inside
                                 : SurfaceNode::corner;
      if (runs_on) line_of_node_[at(node)] = of.line;
    }
  }

  /// For each corner of the reference surface without a node, makes the nearest mesh node a corner
  /// if it is near.
  void hold_corners() {
    std::vector<Index> nodes;
    std::vector<Vec3> places;
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
      if (nodes_[i] == SurfaceNode::none) continue;
      nodes.push_back(static_cast<Index>(i));
      places.push_back(x_[static_cast<Index>(i)]);
    }
    if (nodes.empty()) return;
    const BoxTree<3> tree{std::span<const Vec3>(places)};
    std::vector<Vec3> known;
    for (const auto& [node, place] : corners_) known.push_back(place);
    for (const Vec3& corner : shape_.corners()) {
      if (std::ranges::find(known, corner) != known.end()) continue;
      const auto found = tree.nearest(corner, std::numeric_limits<double>::infinity());
      const Index node = nodes[at(found->item)];
      constexpr double near = 0.7;
      if (found->distance <= near * shortest_[at(node)] && !smooth_.contains(node))
        nodes_[at(node)] = SurfaceNode::corner;
    }
  }

  /// The regions of the reference surface for a region of the mesh: the one nearest to most of its
  /// nodes, then those nearest to nodes that are far from the regions before.
  std::vector<Index> regions_under(std::span<const Index> nodes) const {
    std::map<Index, std::vector<Index>> votes;
    for (const Index node : nodes) {
      const auto place = shape_.nearest_region(x_[node]);
      require_near(node, place.distance);
      votes[place.region].push_back(node);
    }
    std::vector<Index> order;
    for (const auto& [region, voters] : votes) order.push_back(region);
    std::ranges::stable_sort(order, std::greater<>(),
                             [&](Index region) { return votes.at(region).size(); });
    std::vector<Index> chosen;
    const auto is_off = [&](Index node) {
      constexpr double near = 0.5;
      return std::ranges::none_of(chosen, [&](Index region) {
        return shape_.distance_to_region(region, x_[node]) <= near * shortest_[at(node)];
      });
    };
    for (const Index region : order)
      if (chosen.empty() || std::ranges::any_of(votes.at(region), is_off)) chosen.push_back(region);
    std::ranges::sort(chosen);
    return chosen;
  }

  /// Throws UsageError for a node far from the surface, which is then of another body or in another
  /// unit.
  void require_near(Index node, double distance) const {
    constexpr double far = 0.1;  // of the mesh
    if (distance <= far * extent_) return;
    throw UsageError(shape_.source() + ": node " + std::to_string(node) + " at " +
                     place_text(Vec3(x_[node])) + " is " + number_text(distance) +
                     " away from this surface, expected a surface that the nodes lie near to, in "
                     "the unit of the mesh");
  }

  void add_region(std::span<const Index> region) {
    const std::vector<Index> inside = nodes_inside(sliding_, nodes_, region);
    if (inside.empty()) return;
    const std::vector<Index> under = regions_under(inside);
    auto& surface = surfaces_[under];
    if (!surface) surface = shape_.surface(under);
    const Index marker = sliding_.faces[at(region.front())].marker;
    out_.parts.push_back(
        {part_name(markers_, marker), surface->description() + " of " + shape_.source(), inside});
    geometry_->add(surface, inside, x_);
  }

  void add_curves() {
    std::map<Index, std::vector<Index>> nodes_on;
    for (std::size_t i = 0; i < nodes_.size(); ++i)
      if (nodes_[i] == SurfaceNode::line && sliding_.stays[i] == 0)
        nodes_on[line_of_node_[i]].push_back(static_cast<Index>(i));
    const std::map<Index, Index> marker_at = markers_at(sliding_.faces);
    for (const auto& [line, nodes] : nodes_on) {
      const auto& curve = shape_.curve(line);
      if (!curve) continue;
      geometry_->add(curve, nodes);
      out_.parts.push_back({part_name(markers_, marker_at.at(nodes.front())),
                            edge_description(*curve) + " of " + shape_.source(), nodes});
    }
  }

  const Topology& topology_;
  const SlidingMarkers& markers_;
  SpacePoints x_;
  SlidingFaces sliding_;
  SurfaceEdges edges_;
  ReferenceShape shape_;
  std::set<Index> smooth_;
  std::vector<Index> line_of_edge_;  // #edges; -1: of none
  std::vector<unsigned char> cut_;   // #edges
  std::vector<double> shortest_;     // #nodes, length of the shortest edge
  std::map<Index, Vec3> corners_;    // of the reference surface, for these nodes
  std::set<Index> fading_;           // nodes behind which a line fades out
  std::vector<SurfaceNode> nodes_;   // #nodes
  std::vector<Index> line_of_node_;  // #nodes
  std::vector<Index> bends_;         // at which a line turns
  std::map<std::vector<Index>, std::shared_ptr<const Surface>> surfaces_;  // by regions under
  double extent_ = 0;                                                      // of the sliding faces
  std::shared_ptr<SpaceGeometry> geometry_ = std::make_shared<SpaceGeometry>();
  SlidingBoundary out_;
};

}  // namespace

SlidingBoundary sliding_on_reference(const Topology& topology, const Coordinates& x,
                                     const SlidingMarkers& markers, const FeatureRules& rules,
                                     const ReferenceSurface& reference) {
  return ReferenceFinder(topology, x, markers, rules, reference).boundary(rules.slide_along);
}

}  // namespace winslow
