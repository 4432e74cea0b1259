#include <algorithm>
#include <map>
#include <utility>

#include "core/geometry/boundary_kinds.h"
#include "core/geometry/sliding_faces.h"
#include "core/geometry/space_geometry.h"
#include "core/geometry/surface_shapes.h"

namespace winslow {

namespace {

/// What the nodes of the faces of sliding markers slide on.
class SurfaceFinder {
 public:
  SurfaceFinder(const Topology& topology, const Coordinates& x, std::span<const Index> markers,
                const FeatureRules& rules)
      : topology_(topology),
        x_(x),
        sliding_(sliding_faces(topology, markers)),
        features_(find_features(x, sliding_.faces, rules.angle, rules.smooth)) {
    require_smooth(rules, features_.nodes, sliding_.stays);
  }

  SlidingBoundary boundary(bool features) {
    curves_ = curves_along(x_, features_);
    for (const std::vector<Index>& region : faces_of_regions(features_)) add_region(region);
    if (features) add_curves();
    out_.geometry = geometry_;
    add_bends(features_.tips);
    if (features) add_bends(features_.bends);
    std::ranges::sort(out_.bends);
    return std::move(out_);
  }

 private:
  void add_bends(std::span<const Index> nodes) {
    for (const Index node : nodes)
      if (sliding_.stays[at(node)] == 0) out_.bends.push_back(node);
  }

  void add_curves() {
    const std::map<Index, Index> marker_at = markers_at(sliding_.faces);
    for (std::size_t k = 0; k < curves_.curves.size(); ++k) {
      const auto& curve = curves_.curves[k];
      if (!curve) continue;
      std::vector<Index> nodes;
      for (const Index node : features_.lines[k].nodes)
        if (features_.nodes[at(node)] == SurfaceNode::line && sliding_.stays[at(node)] == 0)
          nodes.push_back(node);
      if (nodes.empty()) continue;
      std::string what = curve->description();
      what = what == "straight line" ? "straight edge" : "edge, " + what;
      geometry_->add(curve, nodes);
      out_.parts.push_back({part_name(topology_, marker_at.at(nodes.front())), what, nodes});
    }
  }

  void add_region(std::span<const Index> region) {
    std::vector<Index> inside;
    for (const Index node : nodes_of_faces(sliding_.faces, region))
      if (features_.nodes[at(node)] == SurfaceNode::inside && sliding_.stays[at(node)] == 0)
        inside.push_back(node);
    if (inside.empty()) return;
    auto through = surface_over(x_, sliding_.faces, region, curves_);
    out_.parts.push_back({part_name(topology_, sliding_.faces[at(region.front())].marker),
                          through->description(), inside});
    geometry_->add(std::move(through), inside, x_);
  }

  const Topology& topology_;
  SpacePoints x_;
  SlidingFaces sliding_;
  SurfaceFeatures features_;
  FeatureCurves curves_;
  std::shared_ptr<SpaceGeometry> geometry_ = std::make_shared<SpaceGeometry>();
  SlidingBoundary out_;
};

}  // namespace

void require_smooth(const FeatureRules& rules, std::span<const SurfaceNode> nodes,
                    std::span<const unsigned char> stays) {
  for (const Index node : rules.smooth) {
    const SurfaceNode what = nodes[at(node)];
    const char* fault = what == SurfaceNode::none     ? "it is no node of what slides"
                        : stays[at(node)] != 0        ? "it meets the boundary that does not slide"
                        : what == SurfaceNode::corner ? "feature lines end or meet there"
                        : what == SurfaceNode::line && !rules.slide_along
                            ? "it lies on a feature line, and nodes are not to slide along these"
                            : nullptr;
    if (fault) throw UsageError("node " + std::to_string(node) + " cannot be smooth: " + fault);
  }
}

SlidingBoundary sliding_on_surfaces(const Topology& topology, const Coordinates& x,
                                    std::span<const Index> markers, const FeatureRules& rules) {
  return SurfaceFinder(topology, x, markers, rules).boundary(rules.slide_along);
}

}  // namespace winslow
