#pragma once

#include "core/mesh/mesh_data.h"

/// For formats that say of a cell only which faces it has (OpenFOAM's polyMesh, NFACE_n and
/// ParentElements of CGNS):
///
///     add_cell_of_faces(faces, data);
namespace winslow::io {

/// An element that was put together from its faces.
struct CellOfFaces {
  ElementType type;
  std::vector<Index> corners;  ///< in the order of ElementShape
};

/// The element with these faces, which are counter-clockwise seen from outside (only that of the
/// base counts). Returns nothing if it is no tetrahedron, pyramid, prism or hexahedron. Corner 0 is
/// the first node of the first triangle (pyramid: of the quadrilateral; hexahedron: of the first
/// face).
std::optional<CellOfFaces> cell_of_faces(std::span<const Face> faces);

/// Adds the element with these faces: a tetrahedron, pyramid, prism or hexahedron if it is one,
/// else a polyhedron.
void add_cell_of_faces(std::span<const Face> faces, MeshData& data);

}  // namespace winslow::io
