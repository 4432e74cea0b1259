#pragma once

#include "io/gmsh/gmsh.h"

namespace winslow::io::gmsh {

/// Details for a mesh that came from another format: a curve entity per marker, a surface entity
/// per region, all in one surface "domain" where there are no regions (Gmsh leaves elements without
/// physical group out when it saves).
Details make_details(const Mesh& mesh, bool version_4, std::vector<std::string>& warnings);

}  // namespace winslow::io::gmsh
