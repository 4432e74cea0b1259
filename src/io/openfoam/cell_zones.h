#pragma once

#include "io/format/parsed_mesh.h"

/// Cell zones of OpenFOAM are the regions of a mesh:
///
///     read_cell_zones(source, "case/constant/polyMesh", mesh);
///     mesh.data.regions[0].name;  // "rotor"
namespace winslow::io::openfoam {

/// Reads the file cellZones of a polyMesh folder, if it is there, and makes a region of each zone
/// that has cells. The mesh must have its cells already. A cell of several zones belongs to the
/// first; a warning counts such cells. The file may be text or binary (labels of 32 or 64 bits, as
/// its entry "arch" says), and compressed. Throws InputError "cellZones:LINE: ..." for a list that
/// is none, and for a cell that the mesh does not have.
void read_cell_zones(Source& source, const std::filesystem::path& folder, ParsedMesh& mesh);

}  // namespace winslow::io::openfoam
