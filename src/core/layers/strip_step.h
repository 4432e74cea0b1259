#pragma once

#include <array>
#include <vector>

#include "core/mesh/half_edge.h"
#include "core/mesh/topology.h"

namespace winslow {

/// One row of a strip of elements between two columns: a quadrilateral, or the two triangles that a
/// diagonal makes of one.
struct StripStep {
  Index left = -1, right = -1;            ///< nodes that the two columns go on to
  std::array<Index, 2> elements{-1, -1};  ///< second: -1 if the first is a quadrilateral
  OpenMesh::HalfedgeHandle top;           ///< from `left` to `right`, what is above on its left
};

/// The rows that may lie above an edge, which leads from the left column to the right one with what
/// is above on its left: one for a quadrilateral; for a triangle up to two, with the triangle
/// beyond either of its other sides; none at the boundary. Geometry has to tell which of two it is.
std::vector<StripStep> steps_above(const Topology& topology, OpenMesh::HalfedgeHandle edge);

}  // namespace winslow
