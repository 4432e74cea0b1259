#include "core/geometry/boundary_kinds.h"

#include <Eigen/Geometry>
#include <set>
#include <utility>

#include "core/geometry/surface_features.h"
#include "core/options/option.h"
#include "core/parallel/parallel_for.h"
#include "core/search/box_tree.h"

namespace winslow {

namespace {

Foot on_curve(const SpaceCurve& curve, const Vec3& point) {
  const CurvePoint<3> place = curve.nearest(point);
  Foot foot;
  foot.point = place.point;
  foot.frame.add(place.tangent);
  foot.bend[0] = place.curvature;
  return foot;
}

/// direction: the first vector of the frame is its projection onto the surface, so that frames of
/// near places are near to each other.
Foot on_surface(const Surface& surface, const Vec3& direction, const Vec3& point) {
  const SurfacePoint place = surface.nearest(point);
  const Vec3& n = place.normal;
  Vec3 first = direction - direction.dot(n) * n;
  constexpr double least = 0.1;
  first = first.norm() > least ? Vec3(first.normalized()) : n.unitOrthogonal();
  const Vec3 second = n.cross(first);
  Foot foot;
  foot.point = place.point;
  foot.frame.add(first);
  foot.frame.add(second);
  foot.bend = {first.dot(place.form * first) * n, first.dot(place.form * second) * n,
               second.dot(place.form * second) * n};
  return foot;
}

}  // namespace

Foot SpaceGeometry::foot(Index node, const Vec3& point) const {
  const Slider& slider = sliders_[at(numbers_.of(node))];
  const Piece& piece = pieces_[at(slider.piece)];
  return piece.surface ? on_surface(*piece.surface, slider.direction, point)
                       : on_curve(*piece.curve, point);
}

void SpaceGeometry::add(std::shared_ptr<const Surface> surface, std::span<const Index> nodes,
                        const SpacePoints& x) {
  constexpr Index block = 512;  // small, since each item is a search in a triangulation
  const std::size_t first = sliders_.size();
  sliders_.resize(first + nodes.size(), {static_cast<Index>(pieces_.size()), Vec3::Zero()});
  const auto find = [&](Index begin, Index end) {
    for (std::size_t i = at(begin); i < at(end); ++i)
      sliders_[first + i].direction = surface->nearest(x[nodes[i]]).normal.unitOrthogonal();
  };
  parallel_for(0, static_cast<Index>(nodes.size()), find, block);
  for (std::size_t i = 0; i < nodes.size(); ++i)
    numbers_.set(nodes[i], static_cast<Index>(first + i));
  pieces_.push_back({std::move(surface), nullptr});
}

void SpaceGeometry::add(std::shared_ptr<const SpaceCurve> curve, std::span<const Index> nodes) {
  for (const Index node : nodes) {
    numbers_.set(node, static_cast<Index>(sliders_.size()));
    sliders_.push_back({static_cast<Index>(pieces_.size()), Vec3::Zero()});
  }
  pieces_.push_back({nullptr, std::move(curve)});
}

SlidingFaces sliding_faces(const Topology& topology, const SlidingMarkers& markers) {
  SlidingFaces out;
  out.stays.assign(at(topology.node_count()), 0);
  for (const SurfaceFace& face : boundary_faces(topology, markers.all)) {
    if (is_surface(topology) || markers.slides(face.marker))
      out.faces.push_back(face);
    else
      for (const Index node : face.nodes) out.stays[at(node)] = 1;
  }
  if (markers.along_regions)
    for (SurfaceFace& face : out.faces) face.marker = topology.element_regions()[at(face.element)];
  return out;
}

std::vector<Index> nodes_inside(const SlidingFaces& sliding, std::span<const SurfaceNode> nodes,
                                std::span<const Index> region) {
  std::vector<Index> inside = nodes_of_faces(sliding.faces, region);
  std::erase_if(inside, [&](Index node) {
    return nodes[at(node)] != SurfaceNode::inside || sliding.stays[at(node)] != 0;
  });
  return inside;
}

std::string edge_description(const SpaceCurve& curve) {
  const std::string what = curve.description();
  return what == "straight line" ? "straight edge" : "edge, " + what;
}

std::string part_name(const SlidingMarkers& markers, Index marker) {
  return marker < 0 || markers.along_regions ? std::string("surface") : markers.name(marker);
}

std::map<Index, Index> markers_at(std::span<const SurfaceFace> faces) {
  std::map<Index, Index> marker_at;
  for (const SurfaceFace& face : faces)
    for (const Index node : face.nodes) {
      const auto [place, is_new] = marker_at.try_emplace(node, face.marker);
      if (!is_new) place->second = std::min(place->second, face.marker);
    }
  return marker_at;
}

namespace {

/// Finds the surfaces and curves of the faces of sliding markers.
class SurfaceFinder {
 public:
  SurfaceFinder(const Topology& topology, const Coordinates& x, const SlidingMarkers& markers,
                const FeatureRules& rules)
      : topology_(topology),
        markers_(markers),
        coordinates_(x),
        x_(x),
        sliding_(sliding_faces(topology, markers)),
        features_(find_features(x, sliding_.faces, rules.angle, rules.smooth)),
        at_corners_(markers) {
    require_smooth(rules, features_.nodes, sliding_.stays);
  }

  SlidingBoundary boundary(bool features, std::span<const PeriodicPairs> periodic) {
    curves_ = curves_along(x_, features_);
    for (const std::vector<Index>& region : features_.regions) add_region(region);
    add_curves(features);
    for (const PeriodicPairs& pairs : periodic)
      if (!pairs.halo) add_corners(pairs);
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

  /// The border of two regions of a surface mesh that a feature line is; null if it is none.
  const RegionInterface* border_along(const Chain& line) const {
    if (!markers_.along_regions) return nullptr;
    const RegionInterface* border = nullptr;
    for (std::size_t k = 0; k + 1 < line.nodes.size(); ++k) {
      const std::array<Index, 2> edge{std::min(line.nodes[k], line.nodes[k + 1]),
                                      std::max(line.nodes[k], line.nodes[k + 1])};
      const auto has_edge = [&](const RegionInterface& meeting) {
        return std::ranges::binary_search(meeting.faces, edge, {}, &Face::edge);
      };
      if (border && has_edge(*border)) continue;
      const auto found = std::ranges::find_if(topology_.interfaces(), has_edge);
      if (border || found == topology_.interfaces().end()) return nullptr;
      border = &*found;
    }
    return border;
  }

  /// all: nodes slide along every feature line; else along borders of regions alone.
  void add_curves(bool all) {
    if (!all && !markers_.along_regions) return;
    const std::map<Index, Index> marker_at = markers_at(sliding_.faces);
    for (std::size_t k = 0; k < curves_.curves.size(); ++k) {
      const auto& curve = curves_.curves[k];
      if (!curve) continue;
      const RegionInterface* border = border_along(features_.lines[k]);
      if (!all && !border) continue;
      std::vector<Index> nodes;
      for (const Index node : features_.lines[k].nodes)
        if (features_.nodes[at(node)] == SurfaceNode::line && sliding_.stays[at(node)] == 0)
          nodes.push_back(node);
      if (nodes.empty()) continue;
      geometry_->add(curve, nodes);
      const Chain& line = features_.lines[k];
      std::vector<Vec3> places;
      for (const Index node : line.nodes) places.push_back(x_[node]);
      const Index marker = marker_at.at(nodes.front());
      out_.parts.push_back(
          {border ? topology_.name_of(*border) : part_name(markers_, marker),
           edge_description(*curve), nodes,
           std::make_shared<const CurveRow>(line.nodes, line.closed, curve, places)});
      out_.parts.back().of_regions = border || markers_.of_regions(marker);
    }
  }

  void add_region(std::span<const Index> region) {
    const std::vector<Index> inside = nodes_inside(sliding_, features_.nodes, region);
    surfaces_.push_back({nullptr, {}});
    if (!inside.empty()) add_part(surfaces_.size() - 1, inside);
  }

  const Surface& surface_of(std::size_t region) {
    auto& surface = surfaces_[region].surface;
    if (!surface) surface = surface_over(x_, sliding_.faces, features_.regions[region], curves_);
    return *surface;
  }

  void add_part(std::size_t region, const std::vector<Index>& nodes) {
    surface_of(region);
    RegionSurface& of = surfaces_[region];
    geometry_->add(of.surface, nodes, x_);
    if (!of.part) {
      of.part = out_.parts.size();
      out_.parts.push_back(
          {part_name(markers_, sliding_.faces[at(features_.regions[region].front())].marker),
           of.surface->description(),
           {}});
      out_.parts.back().of_regions =
          markers_.of_regions(sliding_.faces[at(features_.regions[region].front())].marker);
    }
    auto& all = out_.parts[*of.part].nodes;
    all.insert(all.end(), nodes.begin(), nodes.end());
  }

  /// Adds the corners of periodic sides that can slide, each to the surface that it meets.
  void add_corners(const PeriodicPairs& pairs) {
    if (pairs.corners.empty()) return;
    const std::map<Index, std::size_t> regions = only_regions();
    std::map<std::array<std::size_t, 2>, std::vector<PeriodicPair>> corners;
    for (const PeriodicPair& pair : pairs.corners) {
      at_corners_.require_both(coordinates_, pair);
      const auto first = regions.find(pair.node), second = regions.find(pair.image);
      if (first != regions.end() && second != regions.end() &&
          at_corners_.sliding_at(pair.node, pairs) && at_corners_.sliding_at(pair.image, pairs))
        corners[{first->second, second->second}].push_back(pair);
    }
    for (const auto& [between, list] : corners) {
      const auto [from, to] = between;
      if (!surface_of(from).goes_on() || !surface_of(to).goes_on()) continue;
      require_image(pairs.image, from, to, list.front());
      std::vector<Index> nodes;
      for (const PeriodicPair& pair : list) nodes.push_back(pair.node);
      add_part(from, nodes);
      out_.corners.insert(out_.corners.end(), list.begin(), list.end());
    }
  }

  /// The region of each node of sliding faces that has only one.
  std::map<Index, std::size_t> only_regions() const {
    std::map<Index, std::size_t> region_of;
    std::set<Index> several;
    for (std::size_t r = 0; r < features_.regions.size(); ++r)
      for (const Index node : nodes_of_faces(sliding_.faces, features_.regions[r]))
        if (!region_of.try_emplace(node, r).second) several.insert(node);
    for (const Index node : several) region_of.erase(node);
    return region_of;
  }

  /// Throws UsageError unless the periodic image of one region lies on the surface of another.
  void require_image(const RigidImage& image, std::size_t from, std::size_t to,
                     const PeriodicPair& pair) {
    constexpr double share = 1e-4;  // of the extent, for the rounding of files
    const std::vector<Index> nodes = nodes_of_faces(sliding_.faces, features_.regions[from]);
    Box<3> box = Box<3>::empty();
    for (const Index node : nodes) box.add(x_[node]);
    double off = 0;
    for (const Index node : nodes) {
      const Vec3 place = image.of(x_[node]);
      off = std::max(off, (surface_of(to).nearest(place).point - place).norm());
    }
    if (off <= share * box.size().norm()) return;
    refuse_corner(coordinates_, pair.node, pair.image,
                  part_name(markers_, sliding_.faces[at(features_.regions[from].front())].marker),
                  "is on a " + surface_of(to).description() +
                      ", which the image of that one is off by " + number_text(off));
  }

  struct RegionSurface {
    std::shared_ptr<const Surface> surface;  // null: not made yet
    std::optional<std::size_t> part;
  };

  const Topology& topology_;
  const SlidingMarkers& markers_;
  const Coordinates& coordinates_;
  SpacePoints x_;
  SlidingFaces sliding_;
  SurfaceFeatures features_;
  CornerMarkers at_corners_;
  FeatureCurves curves_;
  std::vector<RegionSurface> surfaces_;  // #regions
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
                                    const SlidingMarkers& markers, const FeatureRules& rules,
                                    std::span<const PeriodicPairs> periodic) {
  return SurfaceFinder(topology, x, markers, rules).boundary(rules.slide_along, periodic);
}

}  // namespace winslow
