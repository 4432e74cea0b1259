#pragma once

#include <array>
#include <span>
#include <vector>

#include "core/mesh/topology.h"
#include "core/types.h"

namespace winslow {

/// The link of an interior node of a volume mesh as a triangulated sphere, in numbers of its own:
/// vertex k is neighbour k of the node, triangles are counter-clockwise seen from outside.
///
/// It is a simplicial complex (no two edges have the same ends) and a sphere, so that its edges are
/// a 3-connected planar graph: what the embedding of sphere_start() rests on. Half-edge 3 t + k
/// leads from corner k of triangle t to the next.
class SphereLink {
 public:
  using Triangle = std::array<Index, 3>;

  SphereLink() = default;
  /// See assign().
  SphereLink(Index vertices, std::span<const Triangle> triangles) { assign(vertices, triangles); }
  SphereLink(const Topology& topology, Index node) { assign(topology, node); }

  /// Takes other triangles and keeps the memory. Throws UsageError, naming what is wrong, unless
  /// they are a sphere as said above: a vertex out of range or without triangles, an edge that has
  /// not one triangle on either side, a vertex where two parts meet, several parts, handles.
  void assign(Index vertices, std::span<const Triangle> triangles);
  /// The link of an interior node of a volume mesh: what is cut off each element at the node, a
  /// quadrilateral at a pyramid's apex along the diagonal from its lowest node. Throws UsageError
  /// for a node of the boundary or of another mesh; MeshError, naming the node, where the link is
  /// none of those above.
  void assign(const Topology& topology, Index node);

  Index vertex_count() const { return static_cast<Index>(first_.size()) - 1; }
  Index triangle_count() const { return static_cast<Index>(triangles_.size()); }
  std::span<const Triangle> triangles() const { return triangles_; }

  /// The half-edge on the other side.
  Index twin(Index half_edge) const { return twins_[at(half_edge)]; }
  Index start_of(Index half_edge) const { return triangles_[at(half_edge / 3)][at(half_edge % 3)]; }
  Index end_of(Index half_edge) const { return ends_[at(half_edge)]; }
  /// Half-edges that leave a vertex, as many as it has neighbours, in no order.
  std::span<const Index> outgoing(Index vertex) const {
    return std::span(outgoing_).subspan(at(first_[at(vertex)]), at(degree(vertex)));
  }
  Index degree(Index vertex) const { return first_[at(vertex) + 1] - first_[at(vertex)]; }

 private:
  void collect_outgoing(Index vertices);
  void pair_half_edges();
  void check_rings() const;
  void check_whole() const;

  std::vector<Triangle> triangles_;
  std::vector<Index> ends_;              // by half-edge
  std::vector<Index> twins_;             // by half-edge
  std::vector<Index> first_, outgoing_;  // rows of half-edges by vertex
};

}  // namespace winslow
