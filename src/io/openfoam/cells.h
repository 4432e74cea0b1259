#pragma once

#include "io/format/parsed_mesh.h"
#include "io/openfoam/poly_mesh.h"

/// The elements of a volume mesh from the faces of its cells.
namespace winslow::io::openfoam {

/// Where the first face of a cell is in the source. faces: of the cell, as
/// PolyMesh::faces_of_cells() has them.
std::size_t place_of_cell(const PolyMesh& mesh, const std::vector<Index>& faces);

/// Adds the cells of a mesh as elements, in their order, as cell_of_faces() makes them. Throws
/// InputError for polyhedra.
void add_cells(const Source& source, const PolyMesh& mesh, ParsedMesh& out);

}  // namespace winslow::io::openfoam
