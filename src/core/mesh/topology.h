#pragma once

#include <mutex>

#include "core/mesh/element_type.h"
#include "core/mesh/index_sets.h"
#include "core/mesh/mesh_data.h"
#include "core/mesh/polygon.h"
#include "core/mesh/polyhedron.h"
#include "core/types.h"

/// The connectivity of a mesh:
///
///     const winslow::Topology& topology = *mesh.topology;
///     for (const winslow::Index other : topology.neighbours(node))
///       std::printf("%d%s\n", other, topology.on_boundary(other) ? " on the boundary" : "");
namespace winslow {

class HalfEdgeMesh;  // OpenMesh connectivity; see core/mesh/half_edge.h

/// Connectivity of a plane, surface or volume mesh. It is built and checked once, shared and never
/// changed.
///
/// The elements of each connected part are oriented alike. Plane elements are counter-clockwise and
/// volume elements are numbered as in ElementShape: the sum of the signed areas or volumes of the
/// part is positive. Elements of a surface mesh are oriented as the first element of their part. An
/// element with the other orientation in the file keeps its first node, and its other nodes are
/// mirrored.
///
/// A face separates two elements: it is an edge of a plane or surface mesh, a polygon of a volume
/// mesh.
class Topology {
 public:
  /// Builds connectivity from raw arrays. Throws MeshError: elements of different dimensions, or of
  /// more dimensions than the space; node id out of range, repeated node in an element; a face of
  /// three elements, a triangle on a quadrilateral of a neighbour, a non-manifold node or edge; a
  /// polygon with fewer than three corners, with more than most_polygon_corners, or in space;
  /// orientation that cannot be made consistent; a plane or volume mesh without boundary; a face of
  /// a marker that is no face of an element.
  static std::shared_ptr<const Topology> build(const MeshData& data);
  ~Topology();

  Topology(const Topology&) = delete;
  Topology& operator=(const Topology&) = delete;

  MeshKind kind() const { return kind_; }
  int cell_dimension() const { return cell_dimension_of(kind_); }
  int space_dimension() const { return space_dimension_; }
  Index node_count() const { return neighbours_.rows(); }
  Index element_count() const { return static_cast<Index>(types_.size()); }

  ElementType element_type(Index e) const { return types_[static_cast<std::size_t>(e)]; }
  std::span<const ElementType> element_types() const { return types_; }
  /// Edges, faces and triangles or tetrahedra of an element.
  const ElementShape& shape(Index e) const {
    if (own_shape_.empty() || own_shape_[at(e)] < 0) return shape_of(element_type(e));
    const std::size_t own = at(own_shape_[at(e)]);
    return polygons_.empty() ? polyhedra_[own]->shape() : polygons_[own]->shape();
  }
  bool has_polyhedra() const { return !polyhedra_.empty(); }
  bool has_polygons() const { return !polygons_.empty(); }
  /// Corners of an element, numbered as in its ElementShape.
  std::span<const Index> element(Index e) const { return elements_[e]; }
  const CompressedRows& elements() const { return elements_; }

  /// Edge neighbours of a node; empty for a node that no element uses. In volume meshes they are
  /// ascending. In plane and surface meshes they are counter-clockwise: the row of a boundary node
  /// starts and ends on the boundary, the row of an interior node starts at its lowest neighbour.
  std::span<const Index> neighbours(Index node) const { return neighbours_[node]; }
  const CompressedRows& neighbour_rows() const { return neighbours_; }
  /// Elements around a node. In volume meshes they are ascending. In plane and surface meshes entry
  /// k lies between neighbour k and neighbour k+1 (cyclic for an interior node; a boundary node has
  /// one element fewer than neighbours). See also node_link().
  std::span<const Index> star(Index node) const { return star_[node]; }

  /// True for the nodes of boundary faces and of markers; a marker may lie inside the mesh.
  bool on_boundary(Index node) const { return on_boundary_[static_cast<std::size_t>(node)] != 0; }
  /// True if some element uses the node.
  bool used(Index node) const { return !neighbours(node).empty(); }
  /// The used nodes that are not on the boundary, ascending.
  std::span<const Index> interior_nodes() const { return interior_nodes_; }

  /// A face and its elements. A boundary face has one element, and elements[1] == -1.
  struct SharedFace {
    Face nodes;  ///< lower node first in a plane or surface mesh; seen from outside elements[0],
                 ///< counter-clockwise, in a volume mesh
    std::array<Index, 2> elements;
  };
  /// Every face once, in the order of their sorted nodes.
  Index face_count() const;
  SharedFace face(Index f) const;
  /// Index of the face with these nodes, in any order.
  std::optional<Index> find_face(const Face& nodes) const;

  /// The faces of a plane or surface mesh; boundary edges have one element, elements[1] == -1.
  struct Edge {
    std::array<Index, 2> nodes;
    std::array<Index, 2> elements;
  };
  /// Throws UsageError for a volume mesh.
  std::span<const Edge> edges() const;

  /// Closed boundary loops of a plane or surface mesh, each with the elements on its left. Throws
  /// UsageError for a volume mesh.
  const std::vector<std::vector<Index>>& boundary_loops() const;

  const Markers& markers() const { return markers_; }

  const std::vector<Region>& regions() const { return regions_; }
  /// Region of each element (index into regions() or -1); empty if there are no regions.
  std::span<const Index> element_regions() const { return element_region_; }
  /// Where regions meet, in the order of their numbers; empty for a mesh of one region. A node of
  /// several interfaces is in each of them. Faces of a marker separate no regions: their nodes
  /// belong to the marker.
  const std::vector<RegionInterface>& interfaces() const { return interfaces_; }
  /// The names of the two regions of an interface: "rock and sand", "rock and no region".
  std::string name_of(const RegionInterface& meeting) const;

  /// Memory of the connectivity, without half-edges.
  std::size_t bytes() const;

  /// Number of elements whose orientation was reversed on load.
  Index reversed_elements() const { return reversed_; }

  /// Half-edges of a plane or surface mesh. The first call makes them, and they are kept; any
  /// thread may call. For a triangle mesh of 500,000 nodes they take 54 MB, as much as the rest of
  /// the topology, and 0.04 s; runs without layers do not need them. Throws UsageError for a volume
  /// mesh.
  const HalfEdgeMesh& half_edges() const;

 private:
  Topology();
  /// Throws UsageError for a volume mesh. what: the thing that it does not have.
  void require_edges(const char* what) const;
  friend class TopologyBuilder;

  MeshKind kind_ = MeshKind::plane;
  int space_dimension_ = 2;
  std::vector<ElementType> types_;
  std::vector<std::unique_ptr<const PolyhedronShape>> polyhedra_;  // one for each
  std::vector<std::unique_ptr<const PolygonShape>> polygons_;      // of several with one shape
  std::vector<Index> own_shape_;  // #elements: index into one of these, or -1; empty: none
  CompressedRows elements_;
  CompressedRows neighbours_;
  CompressedRows star_;
  std::vector<unsigned char> on_boundary_;
  std::vector<Index> interior_nodes_;
  std::vector<Edge> edges_;               // the faces of a plane or surface mesh
  std::vector<SharedFace> volume_faces_;  // the faces of a volume mesh
  std::vector<std::vector<Index>> loops_;
  Markers markers_;
  std::vector<Region> regions_;
  std::vector<Index> element_region_;
  std::vector<RegionInterface> interfaces_;
  Index reversed_ = 0;
  mutable std::once_flag half_edges_made_;
  mutable std::unique_ptr<HalfEdgeMesh> half_edges_;
};

inline bool is_surface(const Topology& topology) { return topology.kind() == MeshKind::surface; }
/// "plane mesh", "surface mesh" or "volume mesh".
inline std::string_view mesh_kind(const Topology& topology) {
  return words_of(topology.kind()).mesh;
}
/// Throws UsageError unless the mesh is of that kind. what: the beginning of the message, as
/// "layers".
void require_kind(const Topology& topology, MeshKind kind, std::string_view what);
inline void require_plane(const Topology& topology, std::string_view what) {
  require_kind(topology, MeshKind::plane, what);
}
/// Throws UsageError unless it is a volume mesh. found: the beginning of the message, which
/// mesh_kind() completes.
void require_volume(const Topology& topology, std::string_view found);

/// Calls visit(2) for a plane mesh and visit(3) for a volume mesh; the argument is a
/// std::integral_constant. Throws as require_plane() for a surface mesh.
template <typename Visit>
decltype(auto) in_dimension(const Topology& topology, std::string_view what, Visit&& visit) {
  if (topology.kind() == MeshKind::volume) return visit(std::integral_constant<int, 3>());
  require_plane(topology, what);
  return visit(std::integral_constant<int, 2>());
}

/// Calls visit(index, face) for every boundary face.
template <class Visit>
void for_boundary_faces(const Topology& topology, const Visit& visit) {
  for (Index f = 0; f < topology.face_count(); ++f) {
    const Topology::SharedFace face = topology.face(f);
    if (face.elements[1] < 0) visit(f, face);
  }
}

/// The nodes inside the mesh, not of its boundary or of a marker, in which regions meet; ascending.
std::vector<Index> interface_nodes_inside(const Topology& topology);

/// The link of a node:
///
///     for (const winslow::Face& face : winslow::node_link(*mesh.topology, node))
///       std::puts(winslow::nodes_text(face).c_str());

/// The link of a node, as one part for each element of its star, in the order of Topology::star():
/// the segment or polygon through the other ends of the element's edges at the node
/// (ElementShape::links), by the nodes of the mesh.
///
/// In a plane or surface mesh the parts are segments from one neighbour to the next,
/// counter-clockwise. In a volume mesh they are triangles, and quadrilaterals at the apex of
/// pyramids, with the node behind them. Together they are a closed curve or surface around an
/// interior node, an open one at a boundary node. Where the star has only triangles or tetrahedra
/// it is the outer boundary of the star.
std::vector<Face> node_link(const Topology& topology, Index node);

}  // namespace winslow
