#include "core/layers/wall_chain.h"

#include <map>

#include "core/error.h"
#include "core/mesh/half_edge.h"

namespace winslow {

Index require_marker(const Topology& topology, const std::string& name) {
  const auto found = topology.markers().find(name);
  if (found) return *found;
  throw UsageError("the mesh has no marker '" + name + "'; it has: " +
                   listed(topology.markers(), [](const Marker& marker) { return marker.name; }));
}

namespace {

/// The walls of the edges that get layers, by the index of the edge in the topology.
std::map<Index, Index> wall_edges(const Mesh& mesh, std::span<const LayerWall> walls) {
  const Topology& topology = *mesh.topology;
  const PlanePoints x(mesh.coordinates);
  std::map<Index, Index> wanted;
  for (std::size_t w = 0; w < walls.size(); ++w) {
    const WallPart& part = walls[w].part;
    bool any = false;
    for (const std::string& name : walls[w].markers) {
      const Index marker = require_marker(topology, name);
      for (const Face& edge : topology.markers()[at(marker)].faces) {
        const auto [a, b] = edge.edge();
        if (!part.holds(x[a]) || !part.holds(x[b])) continue;
        any = true;
        const auto [it, fresh] = wanted.emplace(*topology.find_face(edge), static_cast<Index>(w));
        if (!fresh && it->second != static_cast<Index>(w)) {
          throw UsageError("the layers of marker '" + name + "' are asked for twice");
        }
      }
    }
    if (!any && !walls[w].markers.empty()) {
      throw UsageError("no edge of marker '" + walls[w].markers.front() +
                       "' lies in the part of it that is to have layers");
    }
  }
  if (wanted.empty()) throw UsageError("no marker is given to insert layers at");
  return wanted;
}

void require_boundary(const Topology& topology, const std::map<Index, Index>& wanted) {
  for (const auto& [f, wall] : wanted) {
    const Topology::Edge& edge = topology.edges()[at(f)];
    if (topology.element_type(edge.elements[0]) == ElementType::polygon)
      throw UsageError("element " + std::to_string(edge.elements[0]) +
                       " at the wall is a polygon; layers are inserted beneath triangles and "
                       "quadrilaterals only: cut the polygons at the wall");
    if (edge.elements[1] < 0) continue;
    throw UsageError("the edge between nodes " + std::to_string(edge.nodes[0]) + " and " +
                     std::to_string(edge.nodes[1]) +
                     " has elements on both sides; layers are inserted at the boundary only");
  }
}

/// Walks along the boundary with the elements on the left. Boundary half-edges have the elements on
/// the right, so the walk is against them: the first node of an edge is the end of its half-edge.
class BoundaryWalk {
 public:
  BoundaryWalk(const Topology& topology, const std::map<Index, Index>& wanted)
      : mesh_(topology.half_edges()), wanted_(wanted) {}

  /// Adds the chains of wanted edges in the boundary loop of a node.
  void add_chains(Index node, std::vector<WallChain>& chains) const {
    const Edge start = after(mesh_.halfedge_handle(OpenMesh::VertexHandle(node)));
    bool interrupted = false;
    Edge edge = start;
    do {
      if (wall(edge) < 0) interrupted = true;
      if (wall(edge) >= 0 && wall(before(edge)) < 0) chains.push_back(open_chain(edge));
      edge = after(edge);
    } while (edge != start);
    if (!interrupted) chains.push_back(closed_chain(start));
  }

 private:
  using Edge = OpenMesh::HalfedgeHandle;

  Edge after(Edge edge) const { return mesh_.prev_halfedge_handle(edge); }
  Edge before(Edge edge) const { return mesh_.next_halfedge_handle(edge); }
  Index entry(Edge edge) const { return mesh_.to_vertex_handle(edge).idx(); }
  /// The wall of an edge; -1: it gets no layers.
  Index wall(Edge edge) const {
    const auto it = wanted_.find(mesh_.edge_handle(edge).idx());
    return it == wanted_.end() ? -1 : it->second;
  }

  WallChain open_chain(Edge edge) const {
    WallChain chain;
    chain.before = entry(before(edge));
    for (; wall(edge) >= 0; edge = after(edge)) {
      chain.nodes.push_back(entry(edge));
      chain.wall.push_back(wall(edge));
    }
    chain.nodes.push_back(entry(edge));
    chain.after = entry(after(edge));
    return chain;
  }

  WallChain closed_chain(Edge start) const {
    WallChain chain;
    chain.closed = true;
    Edge edge = start;
    do {
      chain.nodes.push_back(entry(edge));
      chain.wall.push_back(wall(edge));
      edge = after(edge);
    } while (edge != start);
    return chain;
  }

  const HalfEdgeMesh& mesh_;
  const std::map<Index, Index>& wanted_;
};

}  // namespace

std::vector<WallChain> find_wall_chains(const Mesh& mesh, std::span<const LayerWall> walls) {
  const Topology& topology = *mesh.topology;
  require_plane(topology, "layers");
  const std::map<Index, Index> wanted = wall_edges(mesh, walls);
  require_boundary(topology, wanted);
  const BoundaryWalk walk(topology, wanted);
  std::vector<WallChain> chains;
  for (const auto& loop : topology.boundary_loops()) walk.add_chains(loop.front(), chains);
  return chains;
}

double open_angle(const Vec2& previous, const Vec2& next) {
  const double angle = turn_between(next, previous);
  return angle > 0 ? angle : angle + 2 * pi;
}

namespace {

/// Radius |q|^2 / (2 n.q) of the circle through the origin and q with its centre in the unit
/// direction n; infinite if q does not lie on that side.
double touching_radius(const Vec2& q, const Vec2& n) {
  const double height = n.dot(q);
  return height > 1e-12 * q.norm() ? q.squaredNorm() / (2 * height)
                                   : std::numeric_limits<double>::infinity();
}

/// The smallest such radius over the points a + t (b - a), t in [0, 1]. With q(t) = a + t v, it is
/// (A + 2 B t + C t^2) / (2 (D + E t)); where its derivative vanishes,
/// C E t^2 + 2 C D t + 2 B D - A E = 0.
double touching_radius(const Vec2& a, const Vec2& b, const Vec2& n) {
  double least = std::min(touching_radius(a, n), touching_radius(b, n));
  const Vec2 v = b - a;
  const double aa = a.squaredNorm(), bb = a.dot(v), cc = v.squaredNorm();
  const double dd = n.dot(a), ee = n.dot(v);
  const auto consider = [&](double t) {
    if (t > 0 && t < 1) least = std::min(least, touching_radius(a + t * v, n));
  };
  if (std::abs(ee) < 1e-12 * std::sqrt(cc)) {
    consider(-bb / cc);
    return least;
  }
  const double discriminant = cc * cc * dd * dd - cc * ee * (2 * bb * dd - aa * ee);
  if (discriminant < 0) return least;
  const double root = std::sqrt(discriminant);
  consider((-cc * dd + root) / (cc * ee));
  consider((-cc * dd - root) / (cc * ee));
  return least;
}

}  // namespace

Clearance::Clearance(const Topology& topology, const Coordinates& x, double reach)
    : x_(x), reach_(reach) {
  require_plane(topology, "layers");
  std::vector<Box<2>> boxes;
  for (const auto& edge : topology.edges()) {
    if (edge.elements[1] >= 0) continue;
    segments_.push_back({edge.nodes[0], edge.nodes[1]});
    Box<2> box{x.xy(edge.nodes[0]), x.xy(edge.nodes[0])};
    box.add(x.xy(edge.nodes[1]));
    boxes.push_back(box);
  }
  tree_ = BoxTree<2>(boxes);
}

double Clearance::radius(Index node, const Vec2& inward) const {
  const Vec2 p = x_.xy(node);
  // The box of the largest disc, slightly enlarged for round-off.
  const Vec2 centre = p + reach_ * inward;
  constexpr double epsilon = std::numeric_limits<double>::epsilon();
  const Vec2 half = Vec2::Constant((1 + 1e-6) * reach_ + 4 * epsilon * p.cwiseAbs().maxCoeff());
  double least = reach_;
  tree_.overlapping({centre - half, centre + half}, [&](Index s) {
    const Segment& segment = segments_[at(s)];
    if (segment.a == node || segment.b == node) return;
    least = std::min(least, touching_radius(x_.xy(segment.a) - p, x_.xy(segment.b) - p, inward));
  });
  return least;
}

}  // namespace winslow
