#pragma once

#include "io/format/mesh_file.h"

namespace winslow::io::su2 {

/// Reads what a configuration file of SU2 says of the markers of its mesh: planes of symmetry
/// (MARKER_SYM) and periodic sides (MARKER_PERIODIC: two markers, then centre, angles and
/// translation, which the mesh itself tells). Other options mean nothing here. Throws InputError:
/// a list without brackets, a periodic side that is not two names and nine numbers.
MarkerRoles read_config(const std::filesystem::path& path);

}  // namespace winslow::io::su2
