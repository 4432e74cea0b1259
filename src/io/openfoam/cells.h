#pragma once

#include "io/format/parsed_mesh.h"
#include "io/openfoam/poly_mesh.h"

/// The elements of a mesh, from the faces of its cells, and their regions, from its cell zones.
///
///     add_cells(source, poly_mesh, mesh);
///     read_cell_zones(source, place, mesh);
///     mesh.data.regions[0].name;  // "rotor"
namespace winslow::io::openfoam {

/// Adds the cells of a mesh as elements, in their order (add_cell_of_faces()). Throws InputError
/// for a cell without faces.
void add_cells(const Source& source, const PolyMesh& mesh, ParsedMesh& out);

/// Reads the file cellZones of a mesh (find_file()), if there is one, and makes a region of each
/// zone that has cells. The mesh must have its cells already. A cell of several zones belongs to
/// the first; a warning counts such cells. Throws InputError "cellZones:LINE: ..." for a list that
/// is none, and for a cell that the mesh does not have.
void read_cell_zones(Source& source, const MeshPlace& place, ParsedMesh& mesh);

}  // namespace winslow::io::openfoam
