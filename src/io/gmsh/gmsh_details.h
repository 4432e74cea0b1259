#pragma once

#include "io/gmsh/gmsh.h"

namespace winslow::io::gmsh {

/// Details for a mesh that came from another format: a curve (of a volume mesh a surface)
/// entity per marker, a surface (volume) entity per region, all in one entity "domain" where there
/// are no regions (Gmsh leaves elements without physical group out when it saves).
Details make_details(const Mesh& mesh, bool version_4, std::vector<std::string>& warnings);

}  // namespace winslow::io::gmsh
