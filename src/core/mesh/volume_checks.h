#pragma once

#include "core/mesh/mesh.h"

namespace winslow {

/// What mesh_checks.h says of extents and hanging nodes, of a volume mesh.
void check_volumes(const Mesh& mesh);
void check_boundary_faces(const Mesh& mesh);

/// Throws MeshError for a boundary triangle of one element that covers half of a boundary
/// quadrilateral of another.
void check_matching_faces(const Topology& topology);

}  // namespace winslow
