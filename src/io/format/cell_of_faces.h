#pragma once

#include "core/mesh/mesh_data.h"
#include "io/format/parsed_mesh.h"

/// For formats that say of a cell which faces it has (OpenFOAM's polyMesh, NFACE_n and
/// ParentElements of CGNS, polyhedra of VTK):
///
///     make_faces_alike(faces);
///     add_cell_of_faces(faces, mesh.data);
///     give_faces_to_flat_cells(mesh);
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

/// Why faces bound no cell, in words for messages.
struct FacesFault {
  std::string found;     ///< "one face at the edge between nodes 3 and 5"
  std::string expected;  ///< "two: the faces of a cell close"
};

/// Turns faces of a cell so that all of them are counter-clockwise seen from outside, or all
/// clockwise. A face between two cells that a file lists once can be right for one of them only.
/// first_node: the number of node 0 in messages, for formats that count from 1. Returns the number
/// of faces that were turned. Throws FacesFault for fewer than four faces, a face of fewer than
/// three nodes or with a node twice, an edge that has not two faces, and a one-sided surface.
Index make_faces_alike(std::vector<Face>& faces, Index first_node = 0);

/// Makes polyhedra of the elements that are inverted or flat at a corner (has_flat_corner()), but
/// sound by their faces, as finite volumes ask (has_positive_jacobian()). snappyHexMesh makes such
/// hexahedra where a corner comes to lie in a flat part of a wall. A warning counts them. A mesh
/// without polyhedra stays as it is: if its elements are inverted, it is tangled. The coordinates
/// must be set, and the elements have nodes of the mesh.
void give_faces_to_flat_cells(ParsedMesh& mesh);

/// True if two faces with the same nodes go round in the same direction.
bool same_direction(const Face& a, const Face& b);

}  // namespace winslow::io
