#pragma once

#include "core/mesh/coordinates.h"
#include "core/mesh/index_sets.h"
#include "core/search/box_tree.h"

namespace winslow {

/// Nodes and elements of a volume mesh in an order, along the Z-order curve of a box, in which what
/// is near in space is near in memory. Mesh files have them in any order, and most of the time of
/// what goes through the surroundings of many nodes would go into waiting for memory. It serves for
/// as long as the connectivity stays, wherever nodes have gone.
struct CurveOrder {
  /// corners: of the elements. Nodes outside the box are put to its faces.
  CurveOrder(const SpacePoints& x, Index node_count, const Box<3>& box,
             const CompressedRows& corners);

  std::vector<Index> nodes;     ///< of the mesh, by their numbers here
  std::vector<Index> elements;  ///< likewise
  CompressedRows corners;       ///< of elements, both by their numbers here
};

}  // namespace winslow
