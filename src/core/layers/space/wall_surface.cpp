#include "core/layers/space/wall_surface.h"

#include <Eigen/Geometry>
#include <map>

#include "core/error.h"
#include "core/layers/wall_chain.h"
#include "core/mesh/surface_faces.h"

namespace winslow {

namespace {

/// Finds the parts of a WallSurface one after another.
class WallFinder {
 public:
  WallFinder(const Mesh& mesh, std::span<const LayerWall> walls)
      : mesh_(mesh), topology_(*mesh.topology), x_(mesh.coordinates), walls_(walls) {}

  WallSurface find() {
    find_wanted();
    for (const auto& [face, wall] : wanted_) add_face(face, wall);
    list_nodes();
    refuse_polyhedra();
    find_edges();
    find_rim_faces();
    return std::move(surface_);
  }

 private:
  /// The walls of the faces that get layers, by the index of the face in the topology.
  void find_wanted() {
    for (std::size_t w = 0; w < walls_.size(); ++w) {
      bool any = false;
      for (const std::string& name : walls_[w].markers) {
        const Index marker = require_marker(topology_, name);
        for (const Face& face : topology_.markers()[at(marker)].faces) {
          const bool inside = std::ranges::all_of(
              face, [&](Index node) { return walls_[w].part.holds(Vec2(x_[node].head<2>())); });
          if (!inside) continue;
          any = true;
          const auto [it, fresh] = wanted_.emplace(*topology_.find_face(face), static_cast<int>(w));
          if (!fresh && it->second != static_cast<int>(w))
            throw UsageError("the layers of marker '" + name + "' are asked for twice");
        }
      }
      if (!any && !walls_[w].markers.empty()) {
        throw UsageError("no face of marker '" + walls_[w].markers.front() +
                         "' lies in the part of it that is to have layers");
      }
    }
    if (wanted_.empty()) throw UsageError("no marker is given to insert layers at");
  }

  void add_face(Index index, int wall) {
    const Topology::SharedFace face = topology_.face(index);
    if (face.elements[1] >= 0) {
      throw UsageError("the face between " + nodes_text(face.nodes) +
                       " has elements on both sides; layers are inserted at the boundary only");
    }
    if (face.nodes.size() > 4) {
      throw UsageError("the face between " + nodes_text(face.nodes) +
                       " of the wall is a polygon; layers are inserted on triangles and "
                       "quadrilaterals only: cut the polygons of the wall");
    }
    const Vec3 area = -area_vector(x_, face.nodes);
    if (!(area.norm() > 0)) {
      throw UsageError("the face between " + nodes_text(face.nodes) +
                       " of the wall has no area, so that layers have no direction there");
    }
    surface_.faces.push_back(
        {face.nodes.reversed(), index, face.elements[0], wall, area.normalized()});
  }

  void list_nodes() {
    for (const WallFace& face : surface_.faces)
      surface_.nodes.insert(surface_.nodes.end(), face.nodes.begin(), face.nodes.end());
    sort_unique(surface_.nodes);
    surface_.faces_at = rows_at_nodes(surface_.faces);
  }

  void refuse_polyhedra() const {
    if (!topology_.has_polyhedra()) return;
    for (const Index node : surface_.nodes) {
      for (const Index e : topology_.star(node)) {
        if (topology_.element_type(e) != ElementType::polyhedron) continue;
        throw UsageError("element " + std::to_string(e) + " at the wall, at " +
                         node_text(mesh_, node) +
                         ", is a polyhedron; layers are inserted beneath tetrahedra, pyramids, "
                         "prisms and hexahedra only");
      }
    }
  }

  void find_edges() {
    std::vector<SurfaceFace> faces;
    for (const WallFace& face : surface_.faces) faces.push_back({face.nodes, face.element});
    const SurfaceEdges edges = surface_edges(faces);
    for (std::size_t e = 0; e < edges.nodes.size(); ++e) {
      const auto sides = edges.faces[static_cast<Index>(e)];
      WallEdge edge{edges.nodes[e], {sides[0], sides.size() > 1 ? sides[1] : -1}};
      if (sides.size() > 2) {
        throw UsageError("walls touch along the edge from " + node_text(mesh_, edge.nodes[0]) +
                         " to " + node_text(mesh_, edge.nodes[1]) +
                         "; layers need a gap between walls, or walls that are joined");
      }
      if (!edge.at_rim()) {
        edge.turning = turning_between(sides[0], sides[1]);
        join(edge, 0);
        join(edge, 1);
      }
      surface_.edges.push_back(edge);
    }
    surface_.edges_at = rows_at_nodes(surface_.edges);
  }

  /// Positive at a convex ridge.
  double turning_between(Index f, Index g) const {
    const WallFace &a = surface_.faces[at(f)], &b = surface_.faces[at(g)];
    const double angle = std::atan2(a.normal.cross(b.normal).norm(), a.normal.dot(b.normal));
    const Vec3 across = centre_of(x_, b.nodes) - centre_of(x_, a.nodes);
    return across.dot(a.normal - b.normal) < 0 ? angle : -angle;
  }

  /// Notes in one face of an edge which face is beyond.
  void join(const WallEdge& edge, std::size_t side) {
    WallFace& face = surface_.faces[at(edge.faces[side])];
    for (std::size_t k = 0; k < face.nodes.size(); ++k) {
      const auto [low, high] =
          std::minmax({face.nodes[k], face.nodes[(k + 1) % face.nodes.size()]});
      if (low == edge.nodes[0] && high == edge.nodes[1]) face.beside[k] = edge.faces[1 - side];
    }
  }

  void find_rim_faces() {
    std::vector<unsigned char> at_rim(at(topology_.node_count()), 0);
    for (const WallEdge& edge : surface_.edges) {
      if (!edge.at_rim()) continue;
      for (const Index node : edge.nodes) at_rim[at(node)] = 1;
    }
    for_boundary_faces(topology_, [&](Index index, const Topology::SharedFace& face) {
      if (wanted_.contains(index)) return;
      if (std::ranges::none_of(face.nodes, [&](Index node) { return at_rim[at(node)] != 0; }))
        return;
      const Vec3 normal = -area_vector(x_, face.nodes);
      // A face without area has no plane that a column could lie in; its neighbours have.
      if (!(normal.norm() > 0)) return;
      surface_.rim_faces.push_back({face.nodes.reversed(), index, normal.normalized()});
    });
    surface_.rim_faces_at = rows_at_nodes(surface_.rim_faces);
  }

  /// For each node of the walls, the items (faces, edges) that have it.
  template <class Item>
  CompressedRows rows_at_nodes(const std::vector<Item>& items) const {
    return rows_of(static_cast<Index>(surface_.nodes.size()), [&](const auto& add) {
      for (std::size_t i = 0; i < items.size(); ++i) {
        for (const Index node : items[i].nodes) {
          const Index number = surface_.number(node);
          if (number >= 0) add(number, static_cast<Index>(i));
        }
      }
    });
  }

  const Mesh& mesh_;
  const Topology& topology_;
  const SpacePoints x_;
  std::span<const LayerWall> walls_;
  std::map<Index, int> wanted_;
  WallSurface surface_;
};

}  // namespace

Index WallSurface::number(Index node) const {
  const auto it = std::ranges::lower_bound(nodes, node);
  return it != nodes.end() && *it == node ? static_cast<Index>(it - nodes.begin()) : -1;
}

WallSurface find_wall_surface(const Mesh& mesh, std::span<const LayerWall> walls) {
  require_kind(*mesh.topology, MeshKind::volume, "layers in space");
  return WallFinder(mesh, walls).find();
}

std::string node_text(const Mesh& mesh, Index node) {
  return "node " + std::to_string(node) + " at " +
         place_text(place_of(mesh.coordinates, node), mesh.coordinates.dimension());
}

}  // namespace winslow
