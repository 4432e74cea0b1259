#pragma once

#include "core/formulation/cell_targets.h"
#include "core/mesh/coordinates.h"
#include "core/mesh/topology.h"
#include "core/problem/node_classes.h"
#include "core/vcv/sphere/volume_vcvs.h"

namespace winslow {

/// What is particular about single nodes.
struct VolumeTargetNodes {
  const NodeClasses* classes = nullptr;      ///< nodes of the boundary may move; null: none does
  const SphereStencils* stencils = nullptr;  ///< VCVs given by hand; null: none
  /// Elements, ascending, that have targets for their edge_tetrahedra() besides, so that they do
  /// not turn over between their corners.
  std::span<const Index> guarded = {};
};

/// Targets of a volume mesh as the blend says: one for each tetrahedron, one for each corner of the
/// other elements (corner_tetrahedra()). The weights of an element sum to 1; tetrahedra none of
/// whose nodes can move are left out: they cannot change. A target at an edge of a guarded element
/// is the one that the regular element, or the mesh as given, has there; there is none with `rest`
/// where the mesh as given has it inverted.
///
/// `element`: the corners of the regular element of the type. `rest`: the element's own corners in
/// the mesh as given. `automatic`: on the way between these as StretchField says. `vcv`: of a
/// tetrahedron, one target for each of its interior nodes, the one that the node's VCV has in its
/// place (node, three neighbours), blended with the other shares; of a corner of another element,
/// that of the VCV of its node, or the regular one where that lies on the boundary.
///
/// A VCV that was given by hand (stencils; vcvs have them, too) counts whatever the blend, as in
/// the plane: in the targets at its node the shares `automatic` and `element` go to the VCV, and
/// where the blend has no share for VCVs, a tetrahedron with such nodes has the targets at these
/// alone.
///
/// vcvs: may be null if they have no share. given: coordinates (#nodes by 3) of the mesh that the
/// shares `automatic` and `rest` refer to; may be null if those are zero. threads: 0 for all cores;
/// no result depends on it. urgent: elements that count four times as much under `automatic`, once
/// more for each time they are listed. Throws UsageError for shares that are negative or all zero;
/// MeshError if `rest` counts and the mesh has an inverted element.
CellTargets<3> volume_targets(const Topology& topology, const VolumeVcvs* vcvs,
                              const TargetBlend& blend, const Coordinates* given, int threads = 0,
                              std::span<const Index> urgent = {},
                              const VolumeTargetNodes& nodes = {});

}  // namespace winslow
