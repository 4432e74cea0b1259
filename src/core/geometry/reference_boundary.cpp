#include <utility>

#include "core/error.h"
#include "core/geometry/boundary_kinds.h"
#include "core/geometry/reference_shape.h"
#include "core/geometry/space_boundary.h"
#include "core/mesh/coordinates.h"
#include "core/mesh/index_sets.h"
#include "core/options/option.h"

namespace winslow {

namespace {

/// What the nodes of sliding faces slide on, on a reference surface.
class ReferenceFinder {
 public:
  ReferenceFinder(const Topology& topology, const Coordinates& x, std::span<const Index> markers,
                  const FeatureRules& rules, const ReferenceSurface& reference)
      : topology_(topology),
        x_(x),
        sliding_(sliding_faces(topology, markers)),
        edges_(surface_edges(sliding_.faces)),
        shape_(reference, rules.angle),
        smooth_(rules.smooth.begin(), rules.smooth.end()) {
    // Borders, edges between markers and those of several faces alone.
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
    for (const std::vector<Index>& region : regions()) add_region(region);
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
  /// Edges at a node that cut the surface.
  struct NodeEdges {
    std::vector<Index> others;
    Index line = -1;  ///< of all of them; -1: of several, or of none
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

  /// The node nearest to each corner of the reference surface that has none yet, if it is near, is
  /// one.
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
    std::vector<Vec3> taken;
    for (const auto& [node, place] : corners_) taken.push_back(place);
    for (const Vec3& corner : shape_.corners()) {
      if (std::ranges::find(taken, corner) != taken.end()) continue;
      const auto found = tree.nearest(corner, std::numeric_limits<double>::infinity());
      const Index node = nodes[at(found->item)];
      constexpr double near = 0.7;
      if (found->distance <= near * shortest_[at(node)] && !smooth_.contains(node))
        nodes_[at(node)] = SurfaceNode::corner;
    }
  }

  /// Faces that hang together across edges that do not cut the surface.
  std::vector<std::vector<Index>> regions() const {
    JoinedSets sets(sliding_.faces.size());
    for (std::size_t k = 0; k < cut_.size(); ++k)
      if (cut_[k] == 0) {
        const auto around = edges_.faces[static_cast<Index>(k)];
        sets.join(around[0], around[1]);
      }
    std::map<Index, std::vector<Index>> by_lowest;
    for (std::size_t f = 0; f < sliding_.faces.size(); ++f)
      by_lowest[sets.find(static_cast<Index>(f))].push_back(static_cast<Index>(f));
    std::vector<std::vector<Index>> out;
    for (auto& [lowest, faces] : by_lowest) out.push_back(std::move(faces));
    return out;
  }

  /// The regions of the reference surface on which a region of the mesh lies: the one nearest to
  /// most of its nodes, and those nearest to nodes that are off the ones before.
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

  /// Else the surface is that of another body, or in another unit.
  void require_near(Index node, double distance) const {
    constexpr double far = 0.1;  // of the mesh
    if (distance <= far * extent_) return;
    throw UsageError(shape_.source() + ": node " + std::to_string(node) + " at " +
                     place_text(Vec3(x_[node])) + " is " + number_text(distance) +
                     " away from this surface, expected a surface that the nodes lie near to, in "
                     "the unit of the mesh");
  }

  void add_region(std::span<const Index> region) {
    std::vector<Index> inside;
    for (const Index node : nodes_of_faces(sliding_.faces, region))
      if (nodes_[at(node)] == SurfaceNode::inside && sliding_.stays[at(node)] == 0)
        inside.push_back(node);
    if (inside.empty()) return;
    const std::vector<Index> under = regions_under(inside);
    auto& surface = surfaces_[under];
    if (!surface) surface = shape_.surface(under);
    const Index marker = sliding_.faces[at(region.front())].marker;
    out_.parts.push_back(
        {part_name(topology_, marker), surface->description() + " of " + shape_.source(), inside});
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
      std::string what = curve->description();
      what = what == "straight line" ? "straight edge" : "edge, " + what;
      geometry_->add(curve, nodes);
      out_.parts.push_back({part_name(topology_, marker_at.at(nodes.front())),
                            what + " of " + shape_.source(), nodes});
    }
  }

  const Topology& topology_;
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
                                     std::span<const Index> markers, const FeatureRules& rules,
                                     const ReferenceSurface& reference) {
  return ReferenceFinder(topology, x, markers, rules, reference).boundary(rules.slide_along);
}

}  // namespace winslow
