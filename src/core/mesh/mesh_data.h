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

/// What a mesh file says, before anybody has checked it: the input of make_mesh. The dimension of
/// the coordinates is that of the space, the dimension of the elements that of the mesh: a plane
/// mesh has 2 and 2, a surface mesh elements of 2 in space of 3, a volume mesh 3 and 3.
struct MeshData {
  Coordinates coordinates;                ///< #nodes by 2 or 3
  std::vector<ElementType> types;         ///< #elements, all of one dimension
  std::vector<Index> element_offsets{0};  ///< #elements + 1, into element_nodes
  std::vector<Index> element_nodes;       ///< corners of all elements, any orientation
  std::vector<Marker> markers;
  std::vector<Region> regions;
  std::vector<Index> element_region;  ///< #elements, index into regions or -1; empty: no regions

  Index node_count() const { return coordinates.size(); }
  Index element_count() const { return static_cast<Index>(types.size()); }
  /// Dimension of the elements: that of the first one; 2 if there is none.
  int cell_dimension() const { return types.empty() ? 2 : dimension_of(types.front()); }
  std::span<const Index> element(Index e) const {
    const auto b = static_cast<std::size_t>(element_offsets[static_cast<std::size_t>(e)]);
    const auto n = static_cast<std::size_t>(element_offsets[static_cast<std::size_t>(e) + 1]) - b;
    return {element_nodes.data() + b, n};
  }
  void add_element(ElementType type, std::span<const Index> corners) {
    types.push_back(type);
    element_nodes.insert(element_nodes.end(), corners.begin(), corners.end());
    element_offsets.push_back(static_cast<Index>(element_nodes.size()));
  }
};

/// The nodes of some markers:
///
///     const std::vector<std::string> names{"slat", "flap"};
///     const std::vector<winslow::Index> nodes = mesh.topology->markers().nodes_of(names);

/// The markers of a mesh, numbered from 0 on, with the nodes of each.
class Markers {
 public:
  /// Those of the file or, if it has none at all, one for each connected part of the boundary, in
  /// which case from_file() is false and writers leave them out: "loop_1", ... of a plane or
  /// surface mesh, "boundary_1", ... of a volume mesh.
  const std::vector<Marker>& list() const { return list_; }
  bool from_file() const { return from_file_; }

  std::size_t size() const { return list_.size(); }
  bool empty() const { return list_.empty(); }
  const Marker& operator[](std::size_t marker) const { return list_[marker]; }
  auto begin() const { return list_.begin(); }
  auto end() const { return list_.end(); }

  /// Index of the marker of that name, if any.
  std::optional<Index> find(std::string_view name) const;
  /// Sorted unique nodes of a marker.
  std::span<const Index> nodes(Index marker) const { return nodes_[marker]; }
  /// Sorted unique nodes of several markers by name. Throws UsageError naming the known markers.
  std::vector<Index> nodes_of(std::span<const std::string> names) const;
  /// Boundary faces that belong to no marker.
  Index unmarked_faces() const { return unmarked_faces_; }

 private:
  friend class TopologyBuilder;

  std::vector<Marker> list_;
  bool from_file_ = true;
  CompressedRows nodes_;
  Index unmarked_faces_ = 0;
};

}  // namespace winslow
