#pragma once

#include "core/mesh/mesh.h"

namespace winslow {

/// What make_mesh refuses beyond Topology::build. Each throws MeshError naming the offender.
void check_finite(const Coordinates& coordinates);
/// An element that shares no face with another, of a mesh that has several.
void check_isolated(const Topology& topology);
/// Two used nodes in exactly one place, unless they are on the boundary and of different elements:
/// the two sides of a crack or of a baffle without thickness. Returns how many nodes lie where
/// another one does.
Index check_duplicates(const Mesh& mesh);
/// An element whose corners lie on one line, or in one plane for a volume element.
void check_extents(const Mesh& mesh);
/// A boundary node inside a boundary edge or, of a volume mesh, face that it is no corner of.
void check_hanging(const Mesh& mesh);

/// Ascending by their coordinates, x first, then by number.
std::vector<Index> by_position(const Coordinates& coordinates, std::vector<Index> nodes);
/// The nodes of boundary faces, ascending.
std::vector<Index> boundary_nodes(const Topology& topology);

/// What mesh_checks.h says of extents and hanging nodes, of a volume mesh.
void check_volumes(const Mesh& mesh);
void check_boundary_faces(const Mesh& mesh);

/// Throws MeshError for a boundary triangle of one element that covers half of a boundary
/// quadrilateral of another.
void check_matching_faces(const Topology& topology);

}  // namespace winslow
