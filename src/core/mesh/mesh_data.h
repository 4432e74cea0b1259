#pragma once

#include <optional>

#include "core/mesh/coordinates.h"
#include "core/mesh/element_type.h"
#include "core/mesh/index_sets.h"
#include "core/types.h"

/// Two triangles, and a marker on one of their edges:
///
///     winslow::MeshData data;
///     data.coordinates.push_xy({0, 0});
///     data.coordinates.push_xy({1, 0});
///     data.coordinates.push_xy({1, 1});
///     data.coordinates.push_xy({0, 1});
///     data.add_element(winslow::ElementType::triangle, std::array<winslow::Index, 3>{0, 1, 2});
///     data.add_element(winslow::ElementType::triangle, std::array<winslow::Index, 3>{0, 2, 3});
///     data.markers.push_back({"wall", 1, {winslow::Face(0, 1)}});
namespace winslow {

/// A named part of the boundary: edges of a plane or surface mesh, triangles and quadrilaterals of
/// a volume mesh. Faces keep the order of the file, and their nodes its direction.
struct Marker {
  std::string name;
  int tag = 0;  ///< physical tag (Gmsh); 1, 2, ... where the format has none
  std::vector<Face> faces;
};

/// A named set of elements (Gmsh physical surface). Formats without regions have none.
struct Region {
  std::string name;
  int tag = 0;
};

/// Where two regions meet: the faces between them that belong to no marker. These are edges of a
/// plane or surface mesh.
struct RegionInterface {
  /// Indices into Topology::regions(), ascending; -1, which comes last: elements without a region.
  std::array<Index, 2> regions;
  std::vector<Face> faces;   ///< in the order of Topology::face()
  std::vector<Index> nodes;  ///< of the faces, ascending
};

/// Plane meshes have elements of two dimensions in the plane, surface meshes elements of two
/// dimensions in space, volume meshes elements of three dimensions.
enum class MeshKind { plane, surface, volume };

/// The cell dimension and the space dimension of a kind add up to 4, 5 or 6.
constexpr MeshKind kind_of(int cell_dimension, int space_dimension) {
  return static_cast<MeshKind>(cell_dimension + space_dimension - 4);
}
/// Dimension of the elements.
inline constexpr int cell_dimension_of(MeshKind kind) { return kind == MeshKind::volume ? 3 : 2; }

/// The words of messages for meshes of one kind.
struct MeshWords {
  std::string_view mesh;           ///< "plane mesh"
  std::string_view face, a_face;   ///< "edge", "an edge": what separates two elements
  std::string_view has;            ///< an edge "joins" nodes, a face "has" nodes
  std::string_view domain;         ///< "surface", "volume": the union of the elements
  std::string_view boundary_part;  ///< "loop_": how generated names of markers begin
};
const MeshWords& words_of(MeshKind kind);

/// The content of a mesh file before it is checked: the input of make_mesh. See MeshKind for the
/// dimensions of the elements and of the coordinates.
struct MeshData {
  Coordinates coordinates;                ///< #nodes by 2 or 3
  std::vector<ElementType> types;         ///< #elements, all of one dimension
  std::vector<Index> element_offsets{0};  ///< #elements + 1, into element_nodes
  /// Corners of all elements, any orientation; of a polygon as they follow one another around it.
  std::vector<Index> element_nodes;
  /// The faces of polyhedra, by nodes, all of one element counter-clockwise seen from outside or
  /// all clockwise. face_offsets: #elements + 1, into faces; empty: there are no polyhedra.
  std::vector<Face> faces = {};
  std::vector<Index> face_offsets = {};
  std::vector<Marker> markers;
  std::vector<Region> regions;
  std::vector<Index> element_region;  ///< #elements, index into regions or -1; empty: no regions

  Index node_count() const { return coordinates.size(); }
  Index element_count() const { return static_cast<Index>(types.size()); }
  /// Dimension of the elements: that of the first one; 2 if there is none.
  int cell_dimension() const { return types.empty() ? 2 : dimension_of(types.front()); }
  /// Kind of the mesh; elements and coordinates must fit each other.
  MeshKind kind() const { return kind_of(cell_dimension(), coordinates.dimension()); }
  std::span<const Index> element(Index e) const {
    const std::size_t begin = at(element_offsets[at(e)]);
    return {element_nodes.data() + begin, at(element_offsets[at(e) + 1]) - begin};
  }
  bool has_polyhedra() const { return !face_offsets.empty(); }
  /// The faces of a polyhedron; none of another element.
  std::span<const Face> polyhedron(Index e) const {
    if (!has_polyhedra()) return {};
    const std::size_t begin = at(face_offsets[at(e)]);
    return {faces.data() + begin, at(face_offsets[at(e) + 1]) - begin};
  }
  /// Number of faces of an element.
  Index face_count(Index e) const {
    switch (types[at(e)]) {
      case ElementType::polyhedron:
        return static_cast<Index>(polyhedron(e).size());
      case ElementType::polygon:
        return static_cast<Index>(element(e).size());
      default:
        return static_cast<Index>(shape_of(types[at(e)]).faces.size());
    }
  }
  /// Throws UsageError if an Index cannot number the corners of all elements.
  void add_element(ElementType type, std::span<const Index> corners) {
    types.push_back(type);
    element_nodes.insert(element_nodes.end(), corners.begin(), corners.end());
    element_offsets.push_back(index_count(element_nodes.size(), "corners of elements"));
    if (has_polyhedra()) face_offsets.push_back(face_offsets.back());
  }
  /// Adds a polyhedron. Its corners are the nodes of its faces, each once, in the order in which
  /// the faces name them. Throws UsageError as add_element() does.
  void add_polyhedron(std::span<const Face> of_element);
  /// The same with the corners in an order of one's own.
  void add_polyhedron(std::span<const Index> corners, std::span<const Face> of_element);
};

/// The nodes of some markers:
///
///     const std::vector<std::string> names{"slat", "flap"};
///     const std::vector<winslow::Index> nodes = mesh.topology->markers().nodes_of(names);

/// The markers of a mesh, numbered from 0 on, with the nodes of each.
class Markers {
 public:
  /// The markers of the file. If the file has none, one for each connected part of the boundary:
  /// "loop_1", ... of a plane or surface mesh, "boundary_1", ... of a volume mesh. Then from_file()
  /// is false, and writers leave them out.
  const std::vector<Marker>& list() const { return list_; }
  bool from_file() const { return from_file_; }

  std::size_t size() const { return list_.size(); }
  bool empty() const { return list_.empty(); }
  const Marker& operator[](std::size_t marker) const { return list_[marker]; }
  auto begin() const { return list_.begin(); }
  auto end() const { return list_.end(); }

  /// Index of the marker with a name, if there is one.
  std::optional<Index> find(std::string_view name) const;
  /// Sorted unique nodes of a marker.
  std::span<const Index> nodes(Index marker) const { return nodes_[marker]; }
  /// Sorted unique nodes of several markers by name. Throws UsageError naming the known markers.
  std::vector<Index> nodes_of(std::span<const std::string> names) const;
  /// Boundary faces that belong to no marker.
  Index unmarked_faces() const { return unmarked_faces_; }
  /// These markers and more of them behind, such as parts of the inside of a mesh.
  Markers with(std::span<const Marker> more) const;

 private:
  void add_nodes_of(const Marker& marker);
  friend class TopologyBuilder;

  std::vector<Marker> list_;
  bool from_file_ = true;
  CompressedRows nodes_;
  Index unmarked_faces_ = 0;
};

}  // namespace winslow
