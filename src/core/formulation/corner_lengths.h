#pragma once

#include "core/formulation/cell_targets.h"
#include "core/mesh/coordinates.h"

namespace winslow {

/// The targets with the edge lengths that their cells have in a mesh, where a target stands for a
/// corner by itself and not for a whole simplex: both edges of a right-angled corner of a
/// quadrilateral, all three of a hexahedron's; at a corner of a prism the height takes its own
/// length and the two edges of the triangle their mean; at an edge of these (edge_tetrahedra()) the
/// edges that would meet there at right angles, of which one starts from its other end. All other
/// targets stay. x: coordinates of
/// the nodes, in space also for D = 2 (surface meshes).
template <int D>
CellTargets<D> with_corner_lengths(CellTargets<D> targets, const Coordinates& x);
template <>
CellTargets<2> with_corner_lengths(CellTargets<2> targets, const Coordinates& x);
template <>
CellTargets<3> with_corner_lengths(CellTargets<3> targets, const Coordinates& x);

}  // namespace winslow
