#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/mesh/coordinates.h"
#include "core/mesh/mesh_data.h"
#include "core/mesh/topology.h"
#include "core/search/box.h"

namespace winslow {

/// A mesh: connectivity that never changes under smoothing, and where its nodes are.
struct Mesh {
  std::shared_ptr<const Topology> topology;
  Coordinates coordinates;  ///< #nodes by 2, or by 3 in space
};

/// Builds a mesh from raw arrays and checks it geometrically as well as topologically.
///
/// Throws MeshError for what Topology::build refuses and for: a coordinate that is not finite, an
/// element without area or volume, two nodes in the same place, a hanging node (a boundary node
/// inside another element's boundary edge or face), an element that shares no face with the rest of
/// the mesh. Adds a sentence to `warnings` for what is harmless: unused nodes, boundary faces
/// without marker, faces between regions without marker, elements that were turned. Inverted
/// elements are no error: a tangled mesh is what smoothing is for.
Mesh make_mesh(const MeshData& data, std::vector<std::string>* warnings = nullptr);

/// A part of the plane.
using Bounds = Box<2>;
/// Smallest axis-parallel box around all used nodes of a plane mesh. Throws UsageError for another.
Bounds bounds(const Mesh& mesh);
/// The same of a volume mesh.
Box<3> space_bounds(const Mesh& mesh);
Box<3> space_bounds(const Coordinates& coordinates, std::span<const Index> nodes);

/// The same around given nodes. Throws UsageError if there are none.
Bounds bounds(const Coordinates& coordinates, std::span<const Index> nodes);

}  // namespace winslow
