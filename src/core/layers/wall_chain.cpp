#include "core/layers/wall_chain.h"

#include <map>

#include "core/error.h"
#include "core/mesh/half_edge.h"

namespace winslow {

namespace {

Index marker_named(const Topology& topology, const std::string& name) {
  const auto found = topology.markers().find(name);
  if (found) return *found;
  std::string known;
  for (const Marker& marker : topology.markers()) {
    known += (known.empty() ? "" : ", ") + marker.name;
  }
  throw UsageError("the mesh has no marker '" + name + "'; it has: " + known);
}

/// Edges that are to have layers, by their index in the topology, and the wall of each.
std::map<Index, Index> wall_edges(const Mesh& mesh, std::span<const LayerWall> walls) {
  const Topology& topology = *mesh.topology;
  const PlanePoints x(mesh.coordinates);
  std::map<Index, Index> wanted;
  for (std::size_t w = 0; w < walls.size(); ++w) {
    const WallPart& part = walls[w].part;
    bool any = false;
    for (const std::string& name : walls[w].markers) {
      const Index marker = marker_named(topology, name);
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
    if (edge.elements[1] < 0) continue;
    throw UsageError("the edge between nodes " + std::to_string(edge.nodes[0]) + " and " +
                     std::to_string(edge.nodes[1]) +
                     " has elements on both sides; layers are inserted at the boundary only");
  }
}

/// Follows the boundary with the elements on the left. Boundary half-edges have them on the right,
/// so it is walked against them: an edge is entered at the node that its half-edge leads to.
class BoundaryWalk {
 public:
  BoundaryWalk(const Topology& topology, const std::map<Index, Index>& wanted)
      : mesh_(topology.half_edges()), wanted_(wanted) {}

  /// The runs of wanted edges in the boundary loop of a node, from there on.
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
  /// -1: no layers there.
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
  const double angle =
      std::atan2(next.x() * previous.y() - next.y() * previous.x(), next.dot(previous));
  return angle > 0 ? angle : angle + 2 * pi;
}

}  // namespace winslow
