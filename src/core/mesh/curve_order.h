#pragma once

#include <vector>

#include "core/mesh/coordinates.h"
#include "core/search/box.h"

namespace winslow {

/// All nodes along the Z-order curve of a box, in which what is near in space is near in the order.
/// Mesh files have nodes in any order; a loop over the surroundings of many of them, in this one,
/// finds most of what it reads in the processor's caches. Nodes outside the box are put to its
/// faces.
std::vector<Index> along_curve(const SpacePoints& x, Index node_count, const Box<3>& box);

}  // namespace winslow
