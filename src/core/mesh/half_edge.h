#pragma once

#include <OpenMesh/Core/Mesh/PolyConnectivity.hh>
#include <memory>

#include "core/mesh/compressed_rows.h"

namespace winslow {

/// Half-edge connectivity of a plane or surface mesh; vertices and faces are numbered as nodes and
/// elements. Include this header only where half-edges are walked: everything hot runs on
/// Topology's rows.
class HalfEdgeMesh : public OpenMesh::PolyConnectivity {};

/// Half-edges of elements that are oriented alike, at most two at an edge; edge_count: of all
/// elements, each once. Throws MeshError naming an element that cannot be joined to its neighbours
/// (non-manifold node).
std::unique_ptr<HalfEdgeMesh> make_half_edges(const CompressedRows& elements, Index node_count,
                                              std::size_t edge_count);

}  // namespace winslow
