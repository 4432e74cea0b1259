#pragma once

#include "core/layers/layer_spacing.h"
#include "core/mesh/mesh.h"
#include "core/search/box_tree.h"

namespace winslow {

/// Consecutive boundary edges that get layers, with the elements on the left.
struct WallChain {
  std::vector<Index> nodes;  ///< from end to end; of a closed chain the first is not repeated
  bool closed = false;
  std::vector<Index> wall;  ///< #edges: index of the wall of each edge
  /// The boundary nodes before the first and after the last, of a chain that is not closed.
  Index before = -1, after = -1;

  std::size_t edge_count() const { return closed ? nodes.size() : nodes.size() - 1; }
  Index node(std::size_t i) const { return nodes[i % nodes.size()]; }
};

/// Index of the marker with a name. Throws UsageError naming the markers of the mesh.
Index require_marker(const Topology& topology, const std::string& name);

/// Finds the chains of all walls together. Throws UsageError for an unknown marker, an edge of two
/// walls, a marker edge inside the mesh, a polygon at a wall, a wall without an edge, and a mesh
/// that is not plane.
std::vector<WallChain> find_wall_chains(const Mesh& mesh, std::span<const LayerWall> walls);

/// The angle between two boundary edges on the side of the elements, in (0, 2 pi): from direction
/// `next` (to the following node) counter-clockwise to `previous` (to the one before).
double open_angle(const Vec2& previous, const Vec2& next);

/// The clearance at a boundary node: the radius of the largest disc that touches the boundary
/// there, on a given side, and contains no other part of the boundary. In a gap it is half the
/// width, on a concave curve the radius.
class Clearance {
 public:
  /// reach: largest radius of interest, in units of the mesh.
  Clearance(const Topology& topology, const Coordinates& x, double reach);

  /// Radius, at most the reach, of the disc at `node` with its centre in the unit direction
  /// `inward`. The boundary edges at the node itself do not count.
  double radius(Index node, const Vec2& inward) const;

 private:
  struct Segment {
    Index a, b;
  };

  const Coordinates& x_;
  double reach_;
  std::vector<Segment> segments_;
  BoxTree<2> tree_;  // of segments_
};

}  // namespace winslow
