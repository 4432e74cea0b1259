#pragma once

#include <OpenMesh/Core/Mesh/PolyConnectivity.hh>

#include "core/mesh/topology.h"

namespace winslow {

/// Half-edge connectivity of a plane or surface mesh. Vertices, faces and edges are numbered as
/// nodes, elements and Topology::edges(); of the half-edges of an edge the first runs from its
/// lower node to the other one. The half-edge of a boundary vertex is the one on the boundary that
/// leaves it, that of another vertex leads to its lowest neighbour. Include this header only where
/// half-edges are walked: everything hot runs on Topology's rows.
class HalfEdgeMesh : public OpenMesh::PolyConnectivity {};

/// Half-edges of elements that are oriented alike, with their edges; at most two boundary edges at
/// a node.
std::unique_ptr<HalfEdgeMesh> make_half_edges(const CompressedRows& elements,
                                              std::span<const Topology::Edge> edges,
                                              Index node_count);

}  // namespace winslow
