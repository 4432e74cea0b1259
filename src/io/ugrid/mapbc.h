#pragma once

#include <vector>

#include "io/ugrid/ugrid.h"

namespace winslow::io::ugrid {

/// Reads a .mapbc file, appended to the source, if there is one: the number of surfaces; then for
/// each, in a line, its number, its boundary condition (of FUN3D) and its name. Throws InputError.
std::vector<Surface> read_mapbc(Source& source, const std::filesystem::path& path);

/// Names that a .mapbc file can hold: without blanks.
std::string safe_surface_name(const std::string& name);

void write_mapbc(std::ostream& out, const std::vector<Surface>& surfaces);

}  // namespace winslow::io::ugrid
