#include "core/geometry/sliding_boundary.h"

#include <Eigen/Geometry>
#include <cmath>
#include <map>
#include <utility>

#include "core/error.h"
#include "core/geometry/plane_curve.h"

namespace winslow {

namespace {

Vec3 lifted(const Vec2& v) { return {v.x(), v.y(), 0}; }

std::vector<Index> indices_of(const Topology& topology, std::span<const std::string> names) {
  topology.markers().nodes_of(names);  // names the markers that there are, if one is not known
  std::vector<Index> indices;
  for (const std::string& name : names) indices.push_back(*topology.markers().find(name));
  return indices;
}

/// The parts of a boundary and, of each node that slides, which one it is on.
class NodeParts {
 public:
  void set(Index node, Index part) { part_of_[node] = part; }
  Index of(Index node) const {
    const auto found = part_of_.find(node);
    if (found == part_of_.end())
      throw UsageError("node " + std::to_string(node) + " has nothing to slide on");
    return found->second;
  }

 private:
  std::map<Index, Index> part_of_;
};

// ---- The plane ----

class CurveGeometry final : public SlidingGeometry {
 public:
  Foot foot(Index node, const Vec3& point) const override {
    const CurvePoint place =
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

/// Boundary nodes one after the other; a closed row does not repeat its first.
struct Chain {
  std::vector<Index> nodes;
  bool closed = false;
};

/// The edges of one marker as rows of nodes between features.
class ChainFinder {
 public:
  ChainFinder(const Topology& topology, const Coordinates& x, Index marker, double feature_angle)
      : topology_(topology), x_(x), marker_(marker), feature_angle_(radians(feature_angle)) {
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

  std::vector<Chain> find() {
    std::vector<Chain> chains;
    for (const auto& [node, neighbours] : next_)
      if (!passes(node))
        for (const Index neighbour : neighbours)
          if (!walked(node, neighbour)) chains.push_back(walk(node, neighbour));
    for (const auto& [node, neighbours] : next_)  // what is left has no feature: rings
      if (passes(node) && !walked(node, neighbours[0]) && !walked(node, neighbours[1])) {
        Chain ring = walk(node, neighbours[0]);
        ring.nodes.pop_back();
        ring.closed = true;
        chains.push_back(std::move(ring));
      }
    return chains;
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
  bool walked(Index a, Index b) const { return walked_.contains(std::minmax(a, b)); }

  Chain walk(Index from, Index to) {
    Chain chain{{from}, false};
    Index before = from, node = to;
    for (;;) {
      walked_.insert({std::minmax(before, node), true});
      chain.nodes.push_back(node);
      if (node == from || !passes(node)) return chain;
      const auto& neighbours = next_.at(node);
      const Index next = neighbours[0] == before ? neighbours[1] : neighbours[0];
      before = std::exchange(node, next);
    }
  }

  const Topology& topology_;
  const Coordinates& x_;
  Index marker_;
  double feature_angle_;
  std::map<Index, std::vector<Index>> next_;
  std::map<Index, int> others_, edges_at_;
  std::map<std::pair<Index, Index>, bool> walked_;
};

SlidingBoundary find_curves(const Topology& topology, const Coordinates& x,
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
      const bool loop = !chain.closed && chain.nodes.front() == chain.nodes.back();
      if (loop && points.size() < 4) continue;
      auto curve = curve_through(points, chain.closed);
      part.description = curve->description();
      geometry->add(std::move(curve), part.nodes);
      boundary.parts.push_back(std::move(part));
    }
  }
  boundary.geometry = std::move(geometry);
  return boundary;
}

// ---- Space ----

struct Plane {
  Vec3 origin, normal;
};

class PlaneGeometry final : public SlidingGeometry {
 public:
  Foot foot(Index node, const Vec3& point) const override {
    const auto& [plane, frame] = planes_[static_cast<std::size_t>(parts_.of(node))];
    Foot foot;
    foot.point = point - plane.normal.dot(point - plane.origin) * plane.normal;
    foot.frame = frame;
    return foot;
  }
  void add(const Plane& plane, std::span<const Index> nodes) {
    for (const Index node : nodes) parts_.set(node, static_cast<Index>(planes_.size()));
    TangentFrame frame;
    const Vec3 first = plane.normal.unitOrthogonal();
    frame.add(first);
    frame.add(plane.normal.cross(first));
    planes_.emplace_back(plane, frame);
  }

 private:
  std::vector<std::pair<Plane, TangentFrame>> planes_;
  NodeParts parts_;
};

/// Of a face of three or four nodes, its length twice the area.
Vec3 normal_of(const Face& face, const Coordinates& x) {
  const Vec3 a = x.xyz(face[0]), b = x.xyz(face[1]), c = x.xyz(face[2]);
  if (face.size() == 3) return (b - a).cross(c - a);
  return (c - a).cross(x.xyz(face[3]) - b);
}

/// The planes of one marker: faces that follow one another by the same unit normal and distance.
class PlaneFinder {
 public:
  PlaneFinder(const Topology& topology, const Coordinates& x, Index marker)
      : topology_(topology), x_(x), marker_(marker) {
    Vec3 low = x.xyz(0), high = low;
    const auto nodes = topology.markers().nodes(marker);
    if (!nodes.empty()) low = high = x.xyz(nodes.front());
    for (const Index node : nodes) {
      low = low.cwiseMin(x.xyz(node));
      high = high.cwiseMax(x.xyz(node));
    }
    tolerance_ = 1e-6 * (high - low).norm();
  }

  /// Plane of each face of the marker, with all of its nodes in it.
  Index plane_of(const Face& face) {
    const Vec3 normal = normal_of(face, x_);
    if (!(normal.norm() > 0)) return -1;
    for (std::size_t k = 0; k < planes.size(); ++k)
      if (contains(planes[k], face)) return static_cast<Index>(k);
    planes.push_back({x_.xyz(face[0]), normal.normalized()});
    constexpr std::size_t most = 64;
    const std::string& name = topology_.markers()[static_cast<std::size_t>(marker_)].name;
    if (planes.size() > most)
      throw UsageError("marker \"" + name +
                       "\" is curved, and in space nodes can slide on planes only");
    return static_cast<Index>(planes.size()) - 1;
  }

  std::vector<Plane> planes;

 private:
  bool contains(const Plane& plane, const Face& face) const {
    for (const Index node : face)
      if (std::abs(plane.normal.dot(x_.xyz(node) - plane.origin)) > tolerance_) return false;
    return true;
  }

  const Topology& topology_;
  const Coordinates& x_;
  Index marker_;
  double tolerance_;
};

SlidingBoundary find_planes(const Topology& topology, const Coordinates& x,
                            std::span<const Index> markers) {
  constexpr Index untouched = -1, feature = -2;
  const auto count = static_cast<std::size_t>(topology.node_count());
  SlidingBoundary boundary;
  auto geometry = std::make_shared<PlaneGeometry>();
  std::vector<int> markers_at(count, 0);
  for (Index m = 0; m < static_cast<Index>(topology.markers().size()); ++m)
    for (const Index node : topology.markers().nodes(m))
      ++markers_at[static_cast<std::size_t>(node)];
  std::vector<bool> open(count, false);  // at a boundary face of no marker
  if (topology.markers().unmarked_faces() > 0) {
    std::map<std::array<Index, 4>, bool> marked;
    for (const Marker& marker : topology.markers())
      for (const Face& face : marker.faces) marked[face.sorted()] = true;
    for (Index f = 0; f < topology.face_count(); ++f) {
      const auto face = topology.face(f);
      if (face.elements[1] >= 0 || marked.contains(face.nodes.sorted())) continue;
      for (const Index node : face.nodes) open[static_cast<std::size_t>(node)] = true;
    }
  }
  for (const Index marker : markers) {
    const std::string& name = topology.markers()[static_cast<std::size_t>(marker)].name;
    PlaneFinder finder(topology, x, marker);
    std::vector<Index> plane_at(count, untouched);
    for (const Face& face : topology.markers()[static_cast<std::size_t>(marker)].faces) {
      const Index plane = finder.plane_of(face);
      for (const Index node : face) {
        Index& at = plane_at[static_cast<std::size_t>(node)];
        at = at == untouched || at == plane ? plane : feature;
      }
    }
    std::vector<SlidingPart> parts(finder.planes.size(), SlidingPart{name, "plane", {}});
    for (const Index node : topology.markers().nodes(marker)) {
      const auto i = static_cast<std::size_t>(node);
      if (plane_at[i] >= 0 && markers_at[i] == 1 && !open[i])
        parts[static_cast<std::size_t>(plane_at[i])].nodes.push_back(node);
    }
    for (std::size_t k = 0; k < parts.size(); ++k) {
      if (parts[k].nodes.empty()) continue;
      geometry->add(finder.planes[k], parts[k].nodes);
      boundary.parts.push_back(std::move(parts[k]));
    }
  }
  boundary.geometry = std::move(geometry);
  return boundary;
}

}  // namespace

SlidingBoundary SlidingBoundary::find(const Topology& topology, const Coordinates& x,
                                      std::span<const std::string> names, double feature_angle) {
  const std::vector<Index> markers = indices_of(topology, names);
  if (topology.cell_dimension() != topology.space_dimension())
    throw UsageError("nodes of a surface mesh cannot slide");
  SlidingBoundary boundary = topology.cell_dimension() == 2
                                 ? find_curves(topology, x, markers, feature_angle)
                                 : find_planes(topology, x, markers);
  for (const std::string& name : names) {
    bool slides = false;
    for (const SlidingPart& part : boundary.parts) slides |= part.marker == name;
    if (!slides)
      throw UsageError("no node of marker \"" + name +
                       "\" can slide: each lies at a corner or meets another marker");
  }
  return boundary;
}

}  // namespace winslow
