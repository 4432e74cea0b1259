#pragma once

#include "core/mesh/topology.h"

namespace winslow {

/// What a mesh is made of: faces in the plane, faces in space, cells in space. In words:
/// mesh_kind().
enum class MeshKind { plane, surface, volume };

inline MeshKind kind_of(const Topology& topology) {
  if (topology.cell_dimension() == 3) return MeshKind::volume;
  return is_surface(topology) ? MeshKind::surface : MeshKind::plane;
}

/// Dimension of the elements.
inline constexpr int cell_dimension_of(MeshKind kind) { return kind == MeshKind::volume ? 3 : 2; }

}  // namespace winslow
