#pragma once

#include <OpenMesh/Core/Mesh/PolyConnectivity.hh>

namespace winslow {

/// Half-edge connectivity of a mesh; vertices and faces are numbered as nodes and elements.
/// Include this header only where half-edges are walked: everything hot runs on Topology's rows.
class HalfEdgeMesh : public OpenMesh::PolyConnectivity {};

}  // namespace winslow
