#include "core/geometry/sliding_boundary.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "core/error.h"
#include "core/geometry/plane_curve.h"
#include "core/search/box.h"

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

  const Coordinates& x_;
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

/// Planes, and the lines in which two of them meet.
class PlaneGeometry final : public SlidingGeometry {
 public:
  Foot foot(Index node, const Vec3& point) const override {
    const Piece& piece = pieces_[static_cast<std::size_t>(parts_.of(node))];
    Foot foot;
    foot.point = piece.origin;
    for (const Vec3& direction : piece.frame)
      foot.point += direction.dot(point - piece.origin) * direction;
    if (piece.frame.count() == 2)  // what the plane does not say keeps its bits
      foot.point = point - piece.normal.dot(point - piece.origin) * piece.normal;
    foot.frame = piece.frame;
    return foot;
  }
  void add_plane(const Plane& plane, std::span<const Index> nodes) {
    Piece piece{plane.origin, plane.normal, {}};
    const Vec3 first = plane.normal.unitOrthogonal();
    piece.frame.add(first);
    piece.frame.add(plane.normal.cross(first));
    add(piece, nodes);
  }
  void add_line(const Plane& a, const Plane& b, std::span<const Index> nodes) {
    Piece piece;
    const Vec3 direction = a.normal.cross(b.normal).normalized();
    // The place on both planes that is nearest to the origin of the first.
    Eigen::Matrix3d rows;
    rows << a.normal.transpose(), b.normal.transpose(), direction.transpose();
    piece.origin = rows.inverse() *
                   Vec3(a.normal.dot(a.origin), b.normal.dot(b.origin), direction.dot(a.origin));
    piece.frame.add(direction);
    add(piece, nodes);
  }

 private:
  struct Piece {
    Vec3 origin{0, 0, 0}, normal{0, 0, 0};  // the latter of a plane
    TangentFrame frame;
  };
  void add(const Piece& piece, std::span<const Index> nodes) {
    for (const Index node : nodes) parts_.set(node, static_cast<Index>(pieces_.size()));
    pieces_.push_back(piece);
  }

  std::vector<Piece> pieces_;
  NodeParts parts_;
};

/// Of a face of three or four nodes, its length twice the area.
Vec3 normal_of(const Face& face, const Coordinates& x) {
  const Vec3 a = x.xyz(face[0]), b = x.xyz(face[1]), c = x.xyz(face[2]);
  if (face.size() == 3) return (b - a).cross(c - a);
  return (c - a).cross(x.xyz(face[3]) - b);
}

/// The planes of markers, and what each node lies on.
class PlaneFinder {
 public:
  PlaneFinder(const Topology& topology, const Coordinates& x, std::span<const Index> markers)
      : topology_(topology), x_(x), at_(static_cast<std::size_t>(topology.node_count())) {
    find_other_faces(markers);
    for (const Index marker : markers) add_marker(marker);
  }

  /// features: nodes slide on edges as well.
  SlidingBoundary boundary(bool features) const {
    std::map<std::pair<Index, std::vector<Index>>, std::vector<Index>> parts;  // marker, planes
    for (Index node = 0; node < topology_.node_count(); ++node) {
      const NodePlanes& at = at_[static_cast<std::size_t>(node)];
      const bool on_plane = at.planes.size() == 1 && at.markers.size() == 1;
      const bool on_edge = features && at.planes.size() == 2 && meet(at.planes[0], at.planes[1]);
      if (!at.other && (on_plane || on_edge))
        parts[{at.markers.front(), at.planes}].push_back(node);
    }
    SlidingBoundary out;
    auto geometry = std::make_shared<PlaneGeometry>();
    for (const auto& [where, nodes] : parts) {
      const auto& [marker, planes] = where;
      const Plane& first = planes_[static_cast<std::size_t>(planes[0])];
      const bool edge = planes.size() == 2;
      if (edge)
        geometry->add_line(first, planes_[static_cast<std::size_t>(planes[1])], nodes);
      else
        geometry->add_plane(first, nodes);
      out.parts.push_back({topology_.markers()[static_cast<std::size_t>(marker)].name,
                           edge ? "straight edge" : "plane", nodes});
    }
    out.geometry = std::move(geometry);
    return out;
  }

 private:
  struct NodePlanes {
    std::vector<Index> planes, markers;  // ascending
    bool other = false;                  // on a face of the boundary that does not slide
  };

  static void insert(std::vector<Index>& list, Index value) {
    const auto place = std::ranges::lower_bound(list, value);
    if (place == list.end() || *place != value) list.insert(place, value);
  }

  bool meet(Index a, Index b) const {
    constexpr double least = 0.02;  // sine of the angle between them
    return planes_[static_cast<std::size_t>(a)]
               .normal.cross(planes_[static_cast<std::size_t>(b)].normal)
               .norm() > least;
  }

  /// Marks the nodes of other markers and of boundary faces without one.
  void find_other_faces(std::span<const Index> sliding) {
    const Markers& markers = topology_.markers();
    for (Index m = 0; m < static_cast<Index>(markers.size()); ++m)
      if (std::ranges::find(sliding, m) == sliding.end())
        for (const Index node : markers.nodes(m)) at_[static_cast<std::size_t>(node)].other = true;
    if (markers.unmarked_faces() == 0) return;
    std::vector<bool> marked(static_cast<std::size_t>(topology_.face_count()), false);
    for (const Marker& marker : markers)
      for (const Face& face : marker.faces)
        if (const auto f = topology_.find_face(face)) marked[static_cast<std::size_t>(*f)] = true;
    for (Index f = 0; f < topology_.face_count(); ++f) {
      const auto face = topology_.face(f);
      if (face.elements[1] >= 0 || marked[static_cast<std::size_t>(f)]) continue;
      for (const Index node : face.nodes) at_[static_cast<std::size_t>(node)].other = true;
    }
  }

  void add_marker(Index marker) {
    const Marker& data = topology_.markers()[static_cast<std::size_t>(marker)];
    const auto nodes = topology_.markers().nodes(marker);
    Box<3> box = Box<3>::empty();
    for (const Index node : nodes) box.add(x_.xyz(node));
    const double tolerance = 1e-6 * (nodes.empty() ? 0 : box.size().norm());
    const std::size_t before = planes_.size();
    for (const Face& face : data.faces) {
      const Index plane = plane_of(face, tolerance);
      constexpr std::size_t most = 64;
      if (planes_.size() > before + most)
        throw UsageError("marker \"" + data.name +
                         "\" is curved, and in space nodes can slide on planes only");
      for (const Index node : face) {
        NodePlanes& at = at_[static_cast<std::size_t>(node)];
        insert(at.planes, plane);
        insert(at.markers, marker);
      }
    }
  }

  /// The plane in which all nodes of a face lie, one that is known or another.
  Index plane_of(const Face& face, double tolerance) {
    const auto holds = [&](const Plane& plane) {
      return std::ranges::all_of(face, [&](Index node) {
        return std::abs(plane.normal.dot(x_.xyz(node) - plane.origin)) <= tolerance;
      });
    };
    const auto known = std::ranges::find_if(planes_, holds);
    if (known == planes_.end()) {
      const Vec3 normal = normal_of(face, x_);
      planes_.push_back({x_.xyz(face[0]), normal.norm() > 0 ? Vec3(normal.normalized()) : normal});
      return static_cast<Index>(planes_.size()) - 1;
    }
    return static_cast<Index>(known - planes_.begin());
  }

  const Topology& topology_;
  const Coordinates& x_;
  std::vector<NodePlanes> at_;
  std::vector<Plane> planes_;
};

}  // namespace

SlidingBoundary SlidingBoundary::find(const Topology& topology, const Coordinates& x,
                                      std::span<const std::string> names, double feature_angle,
                                      bool features) {
  const std::vector<Index> markers = indices_of(topology, names);
  if (topology.cell_dimension() != topology.space_dimension())
    throw UsageError("nodes of a surface mesh cannot slide");
  SlidingBoundary boundary = topology.cell_dimension() == 2
                                 ? find_curves(topology, x, markers, feature_angle)
                                 : PlaneFinder(topology, x, markers).boundary(features);
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
