#include "core/mesh/boundary_parts.h"

#include "core/mesh/joined_sets.h"

namespace winslow {

namespace {

std::vector<std::vector<Face>> loop_edges(const Topology& topology) {
  std::vector<std::vector<Face>> parts;
  for (const auto& loop : topology.boundary_loops()) {
    auto& part = parts.emplace_back();
    for (std::size_t k = 0; k < loop.size(); ++k) {
      part.emplace_back(loop[k], loop[(k + 1) % loop.size()]);
    }
  }
  return parts;
}

/// Faces around one node of the boundary make up a single disc (check_volume_manifold), so faces
/// that have a node in common hang together by edges.
std::vector<std::vector<Face>> joined_surfaces(const std::vector<Face>& faces, Index node_count) {
  JoinedSets nodes(at(node_count));
  for (const Face& face : faces) {
    for (const Index node : face) nodes.join(face[0], node);
  }
  std::vector<std::vector<Face>> parts;
  std::vector<Index> part_of(at(node_count), -1);  // by the lowest node
  for (const Face& face : faces) {
    Index& part = part_of[at(nodes.find(face[0]))];
    if (part < 0) {
      part = static_cast<Index>(parts.size());
      parts.emplace_back();
    }
    parts[at(part)].push_back(face);
  }
  return parts;
}

}  // namespace

std::vector<std::vector<Face>> boundary_parts(const Topology& topology) {
  if (topology.cell_dimension() == 2) return loop_edges(topology);
  std::vector<Face> faces;
  for (Index f = 0; f < topology.face_count(); ++f) {
    const Topology::SharedFace face = topology.face(f);
    if (face.elements[1] < 0) faces.push_back(face.nodes);
  }
  return joined_surfaces(faces, topology.node_count());
}

}  // namespace winslow
