#include "core/geometry/footholds.h"

#include <iterator>

#include "core/geometry/boundary_kinds.h"
#include "core/mesh/index_sets.h"

namespace winslow {

namespace {

std::vector<Index> common(std::span<const Index> a, std::span<const Index> b) {
  std::vector<Index> out;
  std::ranges::set_intersection(a, b, std::back_inserter(out));
  return out;
}

/// True if all faces of a marker are on the boundary of the mesh.
bool outside(const Topology& topology, const Marker& marker) {
  return std::ranges::all_of(marker.faces, [&](const Face& face) {
    const auto found = topology.find_face(face);
    return found && topology.face(*found).elements[1] < 0;
  });
}

/// What the searches of both dimensions share.
class FootholdSearch {
 public:
  FootholdSearch(const Topology& topology, const FootholdQuery& query)
      : topology_(topology), query_(query), taken_(query.taken) {
    taken_.resize(at(topology.node_count()), 0);
    for (const Index node : query.moving) taken_[at(node)] = 1;
  }

 protected:
  const Topology& topology() const { return topology_; }
  const FootholdQuery& query() const { return query_; }
  std::vector<Index> standing(std::span<const Index> ascending) const {
    return common(ascending, query_.standing);
  }
  std::vector<Index> free_to_slide(std::vector<Index> nodes) const {
    std::erase_if(nodes, [&](Index node) { return taken_[at(node)] != 0; });
    return nodes;
  }
  Foothold& add(std::vector<std::string> markers, std::string description,
                std::vector<Index> nodes) {
    Foothold& foothold = found_.all.emplace_back();
    foothold.body = body_with(topology_, query_.moving, nodes.front());
    foothold.markers = std::move(markers);
    foothold.description = std::move(description);
    foothold.nodes = std::move(nodes);
    return foothold;
  }
  Footholds& found() { return found_; }

 private:
  const Topology& topology_;
  const FootholdQuery& query_;
  std::vector<unsigned char> taken_;  // #nodes
  Footholds found_;
};

class PlaneSearch final : public FootholdSearch {
 public:
  PlaneSearch(const Topology& topology, const Coordinates& x, const FootholdQuery& query)
      : FootholdSearch(topology, query),
        curves_(sliding_on_curves(
            topology, x, {topology, marker_indices(topology, query.markers), Interfaces::free},
            {.angle = query.angle}, {})) {}

  Footholds find() {
    for (SlidingPart& part : curves_.parts)
      if (!part.row->closed()) add_part(part);
    found().sliding.geometry = curves_.geometry;
    return std::move(found());
  }

 private:
  void add_part(SlidingPart& part) {
    std::vector<Index> ends{part.row->first(), part.row->last()};
    sort_unique(ends);
    const std::vector<Index> nodes = standing(ends);
    if (nodes.empty()) return;
    Foothold& foothold = add({part.marker}, part.description, nodes);
    foothold.goes_on = part.goes_on;
    foothold.nearest = [geometry = curves_.geometry, node = part.nodes.front()](const Vec3& p) {
      return geometry->foot(node, p).point;
    };
    part.nodes = free_to_slide(std::move(part.nodes));
    if (part.goes_on && !part.nodes.empty()) found().sliding.parts.push_back(std::move(part));
  }

  SlidingBoundary curves_;
};

class SpaceSearch final : public FootholdSearch {
 public:
  SpaceSearch(const Topology& topology, const Coordinates& x, const FootholdQuery& query)
      : FootholdSearch(topology, query),
        x_(x),
        markers_(topology, markers_of(topology, query), Interfaces::free),
        sliding_(sliding_faces(topology, markers_)),
        features_(find_features(x, sliding_.faces, query.angle)),
        curves_(curves_along(x_, features_)),
        goes_on_(features_.regions.size(), 0) {}

  Footholds find() {
    for (std::size_t r = 0; r < features_.regions.size(); ++r) add_region(r);
    for (std::size_t k = 0; k < features_.lines.size(); ++k) add_line(k);
    found().sliding.geometry = geometry_;
    return std::move(found());
  }

 private:
  static std::vector<Index> markers_of(const Topology& topology, const FootholdQuery& query) {
    std::vector<Index> markers = marker_indices(topology, query.markers);
    const std::vector<Index> more = marker_indices(topology, query.sliding);
    markers.insert(markers.end(), more.begin(), more.end());
    return markers;
  }

  std::string marker_of(std::size_t region) const {
    return part_name(markers_, sliding_.faces[at(features_.regions[region].front())].marker);
  }

  void add_region(std::size_t r) {
    const std::vector<Index>& region = features_.regions[r];
    const std::vector<Index> all = nodes_of_faces(sliding_.faces, region);
    const std::vector<Index> nodes = standing(all);
    if (nodes.empty() || std::ranges::includes(query().moving, all)) return;
    const auto surface = surface_over(x_, sliding_.faces, region, curves_);
    goes_on_[r] = surface->goes_on() ? 1 : 0;
    const std::string marker = marker_of(r);
    if (std::ranges::find(query().markers, marker) == query().markers.end()) return;
    Foothold& foothold = add({marker}, surface->description(), nodes);
    foothold.goes_on = surface->goes_on();
    foothold.nearest = [surface](const Vec3& p) { return surface->nearest(p).point; };
    const std::vector<Index> inside =
        free_to_slide(nodes_inside(sliding_, features_.nodes, region));
    if (!foothold.goes_on || inside.empty()) return;
    geometry_->add(surface, inside, x_);
    found().sliding.parts.push_back({marker, surface->description(), inside});
  }

  /// The parts that have a node.
  std::vector<std::size_t> regions_at(Index node) const {
    std::vector<std::size_t> regions;
    for (std::size_t r = 0; r < features_.regions.size(); ++r)
      if (std::ranges::any_of(features_.regions[r], [&](Index f) {
            return std::ranges::find(sliding_.faces[at(f)].nodes, node) !=
                   sliding_.faces[at(f)].nodes.end();
          }))
        regions.push_back(r);
    return regions;
  }

  void add_line(std::size_t k) {
    const Chain& line = features_.lines[k];
    std::vector<Index> all = line.nodes;
    sort_unique(all);
    const std::vector<Index> nodes = standing(all);
    const auto& curve = curves_.curves[k];
    if (nodes.empty() || !curve) return;
    std::vector<Index> between = line.nodes;
    std::erase_if(between, [&](Index node) {
      return features_.nodes[at(node)] != SurfaceNode::line || sliding_.stays[at(node)] != 0;
    });
    between = free_to_slide(std::move(between));
    if (between.empty()) return;
    std::vector<std::string> markers;
    for (const std::size_t r : regions_at(between.front())) {
      if (goes_on_[r] == 0) return;
      if (const std::string name = marker_of(r); std::ranges::find(markers, name) == markers.end())
        markers.push_back(name);
    }
    Foothold& foothold = add(markers, curve->description(), nodes);
    foothold.edge = true;
    foothold.goes_on = curve->goes_on();
    foothold.nearest = [curve](const Vec3& p) { return curve->nearest(p).point; };
    if (!foothold.goes_on) return;
    geometry_->add(curve, between);
    std::vector<Vec3> places;
    for (const Index node : line.nodes) places.push_back(x_[node]);
    found().sliding.parts.push_back(
        {markers.front(), edge_description(*curve), between,
         std::make_shared<const CurveRow>(line.nodes, line.closed, curve, places)});
  }

  SpacePoints x_;
  SlidingMarkers markers_;
  SlidingFaces sliding_;
  SurfaceFeatures features_;
  FeatureCurves curves_;
  std::vector<unsigned char> goes_on_;  // #regions: 1 for those that standing nodes may slide on
  std::shared_ptr<SpaceGeometry> geometry_ = std::make_shared<SpaceGeometry>();
};

}  // namespace

std::string Foothold::name() const {
  if (!edge) return markers.front();
  return markers.size() > 1 ? "the edge between " + markers[0] + " and " + markers[1]
                            : "an edge of " + markers.front();
}

std::vector<std::string> markers_underfoot(const Topology& topology, std::span<const Index> moving,
                                           std::span<const Index> standing) {
  std::vector<std::string> names;
  const Markers& markers = topology.markers();
  for (std::size_t m = 0; m < markers.size(); ++m) {
    const auto nodes = markers.nodes(static_cast<Index>(m));
    if (!common(nodes, standing).empty() && !std::ranges::includes(moving, nodes) &&
        outside(topology, markers[m]))
      names.push_back(markers[m].name);
  }
  return names;
}

std::string body_with(const Topology& topology, std::span<const Index> moving, Index node) {
  const Markers& markers = topology.markers();
  for (std::size_t m = 0; m < markers.size(); ++m) {
    const auto nodes = markers.nodes(static_cast<Index>(m));
    if (std::ranges::binary_search(nodes, node) && std::ranges::includes(moving, nodes))
      return markers[m].name;
  }
  return {};
}

Footholds find_footholds(const Topology& topology, const Coordinates& x,
                         const FootholdQuery& query) {
  if (topology.kind() == MeshKind::plane) return PlaneSearch(topology, x, query).find();
  return SpaceSearch(topology, x, query).find();
}

}  // namespace winslow
