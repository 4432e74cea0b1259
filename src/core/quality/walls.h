#pragma once

#include <string>
#include <vector>

#include "core/mesh/mesh.h"

namespace winslow {

/// The boundary of a body: a closed loop of the mesh's boundary with the body inside. The loop
/// around the mesh (around each of its connected parts) is none: what of it is a wall, an inlet or
/// a symmetry line, a mesh does not say.
struct Wall {
  std::vector<Index> nodes;          ///< along the loop, the elements on its left; closed
  std::vector<std::string> markers;  ///< that have faces in it, in the order of the mesh's markers
};

/// The walls of a plane mesh, in the order of its boundary loops. Throws UsageError for another.
std::vector<Wall> find_walls(const Mesh& mesh);

}  // namespace winslow
