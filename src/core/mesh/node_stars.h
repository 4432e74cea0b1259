#pragma once

#include <vector>

#include "core/mesh/compressed_rows.h"
#include "core/mesh/element_type.h"
#include "core/mesh/face_pairs.h"

namespace winslow {

class HalfEdgeMesh;

/// What lies around each node (#nodes rows): its edge neighbours and the elements that it is a
/// corner of. Rows of unused nodes are empty.
struct NodeStars {
  CompressedRows neighbours, elements;
};

/// Of a plane or surface mesh, by a turn around each node; ordered as Topology::neighbours() says.
/// elements: those of the half-edge mesh. Throws MeshError naming a node with two separate stars.
NodeStars surface_stars(const HalfEdgeMesh& mesh, const CompressedRows& elements);

/// Of a volume mesh; rows ascend. types: #elements.
NodeStars volume_stars(const std::vector<ElementType>& types, const CompressedRows& elements,
                       Index node_count);

/// Boundary loops of a plane or surface mesh, elements on the left: each starts at its lowest node,
/// and they are in the order of these.
std::vector<std::vector<Index>> boundary_loops(const HalfEdgeMesh& mesh);

/// Throws MeshError naming a node of a plane or surface mesh at which more than two boundary edges
/// meet.
void check_surface_manifold(const MeshData& data, const FacePairs& pairs);

/// Throws MeshError naming a node of a volume mesh around which the elements do not fill one ball
/// or, on the boundary, half of one: parts of the mesh, or of its boundary, that meet in this node
/// or in an edge only. stars: of the mesh.
void check_volume_manifold(const MeshData& data, const FacePairs& pairs, const NodeStars& stars);

}  // namespace winslow
