#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/mesh/coordinates.h"
#include "core/mesh/element_type.h"
#include "core/mesh/face.h"
#include "core/types.h"

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

}  // namespace winslow
