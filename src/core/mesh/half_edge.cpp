#include "core/mesh/half_edge.h"

#include <string>
#include <vector>

#include "core/error.h"

namespace winslow {

std::unique_ptr<HalfEdgeMesh> make_half_edges(const CompressedRows& elements, Index node_count,
                                              std::size_t edge_count) {
  auto mesh = std::make_unique<HalfEdgeMesh>();
  mesh->reserve(static_cast<std::size_t>(node_count), edge_count,
                static_cast<std::size_t>(elements.rows()));
  for (Index i = 0; i < node_count; ++i) mesh->add_vertex();
  std::vector<OpenMesh::VertexHandle> face;
  for (Index e = 0; e < elements.rows(); ++e) {
    face.clear();
    for (const Index node : elements[e]) face.emplace_back(node);
    if (!mesh->add_face(face).is_valid()) {
      throw MeshError(MeshEntity::element, e,
                      "element " + std::to_string(e) +
                          " cannot be joined to its neighbours (non-manifold node)");
    }
  }
  return mesh;
}

}  // namespace winslow
