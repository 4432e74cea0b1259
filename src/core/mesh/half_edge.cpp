#include "core/mesh/half_edge.h"

namespace winslow {

namespace {

using OpenMesh::HalfedgeHandle;
using OpenMesh::VertexHandle;

/// Half-edges joined edge by edge. OpenMesh's own way, face by face, looks for each half-edge
/// around its vertex and takes several times as long.
class Joiner {
 public:
  Joiner(const CompressedRows& elements, std::span<const Topology::Edge> edges, Index node_count)
      : elements_(elements),
        edges_(edges),
        mesh_(std::make_unique<HalfEdgeMesh>()),
        side_(elements.values.size()) {
    mesh_->resize(at(node_count), edges.size(), at(elements.rows()));
  }

  std::unique_ptr<HalfEdgeMesh> join() {
    for (std::size_t f = 0; f < edges_.size(); ++f) add_edge(static_cast<Index>(f), edges_[f]);
    for (Index e = 0; e < elements_.rows(); ++e) add_element(e);
    for (const HalfedgeHandle h : boundary_)
      mesh_->set_halfedge_handle(mesh_->from_vertex_handle(h), h);
    for (const HalfedgeHandle h : boundary_)
      mesh_->set_next_halfedge_handle(h, mesh_->halfedge_handle(mesh_->to_vertex_handle(h)));
    return std::move(mesh_);
  }

 private:
  void add_edge(Index f, const Topology::Edge& edge) {
    const HalfedgeHandle up(2 * f), down(2 * f + 1);
    const VertexHandle low(edge.nodes[0]), high(edge.nodes[1]);
    mesh_->set_vertex_handle(up, high);
    mesh_->set_vertex_handle(down, low);
    // Edges are in the order of their nodes, so the first one at a node leads to the lowest.
    if (mesh_->is_isolated(low)) mesh_->set_halfedge_handle(low, up);
    if (mesh_->is_isolated(high)) mesh_->set_halfedge_handle(high, down);
    bool ascends = false;
    for (const Index e : edge.elements) {
      if (e < 0) {
        boundary_.push_back(ascends ? down : up);
      } else {
        ascends = add_side(e, edge.nodes, up, down);
      }
    }
  }

  /// Gives an element the half-edge of an edge that runs as the element does; is it `up`?
  bool add_side(Index e, const std::array<Index, 2>& nodes, HalfedgeHandle up,
                HalfedgeHandle down) {
    const auto corners = elements_[e];
    std::size_t k = corners.size() - 1;  // the side from the last corner to the first, or:
    bool ascends = corners[k] == nodes[0] && corners[0] == nodes[1];
    for (std::size_t i = 0; i + 1 < corners.size(); ++i) {
      const bool rises = corners[i] == nodes[0] && corners[i + 1] == nodes[1];
      if (!rises && !(corners[i] == nodes[1] && corners[i + 1] == nodes[0])) continue;
      k = i;
      ascends = rises;
    }
    const HalfedgeHandle h = ascends ? up : down;
    side_[at(elements_.offsets[at(e)]) + k] = h;
    mesh_->set_face_handle(h, OpenMesh::FaceHandle(e));
    return ascends;
  }

  void add_element(Index e) {
    const auto begin = at(elements_.offsets[at(e)]), end = at(elements_.offsets[at(e) + 1]);
    mesh_->set_halfedge_handle(OpenMesh::FaceHandle(e), side_[end - 1]);
    for (std::size_t k = begin; k < end; ++k)
      mesh_->set_next_halfedge_handle(side_[k == begin ? end - 1 : k - 1], side_[k]);
  }

  const CompressedRows& elements_;
  std::span<const Topology::Edge> edges_;
  std::unique_ptr<HalfEdgeMesh> mesh_;
  std::vector<HalfedgeHandle> side_;  // of each corner of an element: the one that leaves it there
  std::vector<HalfedgeHandle> boundary_;
};

}  // namespace

std::unique_ptr<HalfEdgeMesh> make_half_edges(const CompressedRows& elements,
                                              std::span<const Topology::Edge> edges,
                                              Index node_count) {
  return Joiner(elements, edges, node_count).join();
}

}  // namespace winslow
