#include "core/layers/strip_step.h"

namespace winslow {

std::vector<StripStep> steps_above(const Topology& topology, OpenMesh::HalfedgeHandle edge) {
  const HalfEdgeMesh& mesh = topology.half_edges();
  const auto from = [&](auto h) { return mesh.from_vertex_handle(h).idx(); };
  const auto to = [&](auto h) { return mesh.to_vertex_handle(h).idx(); };
  const Index first = mesh.face_handle(edge).idx();
  if (first < 0) return {};
  const auto rising = mesh.next_halfedge_handle(edge);  // at the right column, if it is a quad
  const auto second_side = mesh.next_halfedge_handle(rising);
  const auto opposite = [&](auto h) { return mesh.opposite_halfedge_handle(h); };
  if (topology.element_type(first) == ElementType::quadrilateral) {
    return {{to(second_side), from(second_side), {first, -1}, opposite(second_side)}};
  }
  std::vector<StripStep> steps;
  // The diagonal is the side on the right (the apex lies in the left column), or that on the left.
  for (const bool right : {true, false}) {
    const auto beyond = opposite(right ? rising : second_side);
    const Index second = mesh.face_handle(beyond).idx();
    if (second < 0 || topology.element_type(second) != ElementType::triangle) continue;
    const auto a = mesh.next_halfedge_handle(beyond), b = mesh.next_halfedge_handle(a);
    const auto far = right ? b : a;  // from the right column to the left one
    steps.push_back({to(far), from(far), {first, second}, opposite(far)});
  }
  return steps;
}

}  // namespace winslow
