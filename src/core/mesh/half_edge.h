#pragma once

#include <OpenMesh/Core/Mesh/PolyConnectivity.hh>

#include "core/mesh/topology.h"

namespace winslow {

/// Half-edge connectivity of a plane or surface mesh. Vertices, faces and edges have the numbers of
/// nodes, elements and Topology::edges(). The first half-edge of an edge runs from its lower node
/// to the other one. The half-edge of a boundary vertex is the boundary half-edge that leaves it;
/// the half-edge of another vertex leads to its lowest neighbour. Only sources that walk along
/// half-edges include this header; hot loops run on the rows of Topology.
class HalfEdgeMesh : public OpenMesh::PolyConnectivity {};

/// Makes the half-edges of elements that are oriented alike and have at most two boundary edges at
/// each node. edges: of the elements.
std::unique_ptr<HalfEdgeMesh> make_half_edges(const CompressedRows& elements,
                                              std::span<const Topology::Edge> edges,
                                              Index node_count);

}  // namespace winslow
