#pragma once

#include "io/format/parsed_mesh.h"
#include "io/openfoam/case_folder.h"

/// Cell zones of OpenFOAM are the regions of a mesh:
///
///     read_cell_zones(source, place, mesh);
///     mesh.data.regions[0].name;  // "rotor"
namespace winslow::io::openfoam {

/// Reads the file cellZones of a mesh (find_file()), if there is one, and makes a region of each
/// zone that has cells. The mesh must have its cells already. A cell of several zones belongs to
/// the first; a warning counts such cells. Throws InputError "cellZones:LINE: ..." for a list that
/// is none, and for a cell that the mesh does not have.
void read_cell_zones(Source& source, const MeshPlace& place, ParsedMesh& mesh);

}  // namespace winslow::io::openfoam
