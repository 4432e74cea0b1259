#include <algorithm>
#include <string>

#include "core/error.h"
#include "core/mesh/half_edge.h"
#include "core/mesh/node_stars.h"

namespace winslow {

namespace {

using Values = std::vector<Index>;

/// One turn around each node, counter-clockwise.
class StarWalk {
 public:
  explicit StarWalk(const HalfEdgeMesh& mesh) : mesh_(mesh) {
    stars_.neighbours.offsets.reserve(mesh.n_vertices() + 1);
    stars_.neighbours.values.reserve(2 * mesh.n_edges());
    stars_.elements.offsets.reserve(mesh.n_vertices() + 1);
    stars_.elements.values.reserve(2 * mesh.n_edges());
  }

  NodeStars run() {
    for (const OpenMesh::VertexHandle v : mesh_.vertices()) {
      if (!mesh_.is_isolated(v)) turn(v);
      stars_.neighbours.end_row();
      stars_.elements.end_row();
    }
    return std::move(stars_);
  }

 private:
  OpenMesh::HalfedgeHandle next(OpenMesh::HalfedgeHandle h) const {
    return mesh_.opposite_halfedge_handle(mesh_.prev_halfedge_handle(h));
  }

  void turn(OpenMesh::VertexHandle v) {
    // The half-edge of a boundary vertex is the last one counter-clockwise, so the next one across
    // the gap opens the row.
    const auto own = mesh_.halfedge_handle(v);
    const auto start = mesh_.is_boundary(own) ? next(own) : own;
    auto h = start;
    do {
      stars_.neighbours.values.push_back(mesh_.to_vertex_handle(h).idx());
      if (!mesh_.is_boundary(h)) stars_.elements.values.push_back(mesh_.face_handle(h).idx());
      h = next(h);
    } while (h != start);
  }

  const HalfEdgeMesh& mesh_;
  NodeStars stars_;
};

}  // namespace

NodeStars surface_stars(const HalfEdgeMesh& mesh, const CompressedRows& elements) {
  NodeStars stars = StarWalk(mesh).run();
  Values incident(mesh.n_vertices(), 0);
  for (const Index node : elements.values) ++incident[at(node)];
  for (Index node = 0; node < stars.elements.rows(); ++node) {
    if (stars.elements[node].size() == at(incident[at(node)])) continue;
    throw MeshError(
        MeshEntity::node, node,
        "node " + std::to_string(node) + " has two separate stars of elements (non-manifold)");
  }
  return stars;
}

std::vector<std::vector<Index>> boundary_loops(const HalfEdgeMesh& mesh) {
  std::vector<bool> visited(mesh.n_vertices(), false);
  std::vector<std::vector<Index>> loops;
  for (const OpenMesh::VertexHandle seed : mesh.vertices()) {
    if (mesh.is_isolated(seed) || !mesh.is_boundary(seed) || visited[at(seed.idx())]) continue;
    std::vector<Index> loop;
    // Boundary half-edges have the elements on their right: against them they are on the left.
    const auto start = mesh.halfedge_handle(seed);
    auto h = start;
    do {
      const Index node = mesh.from_vertex_handle(h).idx();
      visited[at(node)] = true;
      loop.push_back(node);
      h = mesh.prev_halfedge_handle(h);
    } while (h != start);
    loops.push_back(std::move(loop));
  }
  return loops;
}

void check_surface_manifold(const MeshData& data, const FacePairs& pairs) {
  Values boundary_edges(at(data.node_count()), 0);
  for (Index f = 0; f < pairs.face_count(); ++f) {
    if (pairs.elements[at(f)][1] >= 0) continue;
    const auto [a, b] = first_face(data, pairs, f).edge();
    for (const Index node : {std::min(a, b), std::max(a, b)}) {
      if (++boundary_edges[at(node)] > 2) {
        throw MeshError(MeshEntity::node, node,
                        "node " + std::to_string(node) +
                            " joins parts of the mesh that meet in this node only, expected parts "
                            "to share an edge (non-manifold)");
      }
    }
  }
}

}  // namespace winslow
