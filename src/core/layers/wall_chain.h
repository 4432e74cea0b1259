#pragma once

#include "core/layers/layer_spacing.h"
#include "core/mesh/mesh.h"

namespace winslow {

/// A run of neighbouring boundary edges that are to have layers, elements on the left.
struct WallChain {
  std::vector<Index> nodes;  ///< from end to end; of a closed chain the first is not repeated
  bool closed = false;
  std::vector<Index> wall;  ///< #edges: which of the walls asked for the edge (its place in a list)
  /// The boundary nodes before the first and after the last, of a chain that is not closed.
  Index before = -1, after = -1;

  std::size_t edge_count() const { return closed ? nodes.size() : nodes.size() - 1; }
  Index node(std::size_t i) const { return nodes[i % nodes.size()]; }
};

/// The chains that several walls, or parts of them, make up together. Throws UsageError: an unknown
/// marker, an edge that two walls ask for, a marker edge inside the mesh, a wall without an edge; a
/// mesh that is no plane one.
std::vector<WallChain> find_wall_chains(const Mesh& mesh, std::span<const LayerWall> walls);

/// The angle between two boundary edges on the side of the elements, in (0, 2 pi): from direction
/// `next` (to the following node) counter-clockwise to `previous` (to the one before).
double open_angle(const Vec2& previous, const Vec2& next);

}  // namespace winslow
