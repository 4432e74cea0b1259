#pragma once

#include <vector>

#include "core/mesh/face.h"
#include "core/mesh/topology.h"

namespace winslow {

/// The link of a node: what each element of its star cuts off (see ElementShape::links), by the
/// nodes of the mesh, in the order of Topology::star().
///
/// In a plane or surface mesh these are segments from one neighbour to the next, counter-clockwise;
/// in a volume mesh polygons with the node behind them: triangles, and quadrilaterals at the apex
/// of pyramids. They make up a closed curve or surface around an interior node, an open one at a
/// boundary node. Of triangles and tetrahedra it is the outer boundary of the star; elements with
/// more corners are cut.
std::vector<Face> node_link(const Topology& topology, Index node);

}  // namespace winslow
