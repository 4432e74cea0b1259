#pragma once

#include "core/formulation/cell_targets.h"
#include "core/mesh/coordinates.h"

namespace winslow {

/// Gives targets of single corners the edge lengths that the corner has in a mesh. Then only its
/// angles count. Which edges that are depends on the element:
///
/// - quadrilateral: both edges of a corner; hexahedron: all three;
/// - prism: the edge along its height; the two edges of the triangle take their mean length;
/// - edge_tetrahedra() of these: the edges that would meet there at right angles, one of which
/// starts
///   at the other end of the edge.
///
/// Targets of triangles and tetrahedra stay, since those stand for the whole element. x:
/// coordinates of the nodes, in space also for D = 2 (surface meshes).
template <int D>
CellTargets<D> with_corner_lengths(CellTargets<D> targets, const Coordinates& x);
template <>
CellTargets<2> with_corner_lengths(CellTargets<2> targets, const Coordinates& x);
template <>
CellTargets<3> with_corner_lengths(CellTargets<3> targets, const Coordinates& x);

}  // namespace winslow
