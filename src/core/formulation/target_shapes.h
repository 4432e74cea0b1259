#pragma once

#include "core/formulation/cell_targets.h"
#include "core/mesh/coordinates.h"
#include "core/mesh/topology.h"
#include "core/problem/node_classes.h"
#include "core/types.h"
#include "core/vcv/sphere/volume_vcvs.h"
#include "core/vcv/virtual_control_volumes.h"

namespace winslow {

/// All targets of a plane mesh or a surface mesh: triangles, and corners of quadrilaterals, each
/// with one or more terms. The terms of an element have weights that sum to its own
/// (element_weight()), however many of its nodes lie at the boundary.
/// Triangles none of whose nodes can move are left out: they cannot change.
///
/// A VCV that was edited (VirtualControlVolumes::edited) counts whatever the blend: in the corners
/// at such a node the shares `automatic` and `element` go to the VCV, and where the blend has no
/// share for VCVs at all, a triangle with such corners has the targets of these alone. A corner at
/// the boundary of a quadrilateral with such corners takes part: its target is the parallelogram of
/// theirs. Elements of some roles do not heed edited VCVs: ignores_vcvs().
struct TargetShapes : CellTargets<2> {
  /// Targets over the VCVs as the blend says. given: coordinates of the mesh that the
  /// shares `automatic` and `rest` refer to; may be null if those are zero. threads: 0 for all
  /// cores. urgent: elements that count four
  /// times as much under `automatic`, once more for each time they are listed. classes: nodes of
  /// the boundary may slide; null: only those inside move. normals: of a surface mesh, those of its
  /// elements in the mesh as given (ElementNormals); needed if `given` is. roles: of the elements;
  /// null: nothing is known of them.
  /// Throws UsageError for shares that are negative or all zero, MeshError if `rest` counts
  /// and the mesh has an inverted element.
  static TargetShapes build(const VirtualControlVolumes& vcv, const TargetBlend& blend,
                            const Coordinates* given, int threads = 0,
                            std::span<const Index> urgent = {},
                            const NodeClasses* classes = nullptr,
                            std::span<const Vec3> normals = {},
                            const ElementRoles* roles = nullptr);
};

/// What is particular about single nodes and elements.
struct VolumeTargetDetails {
  const NodeClasses* classes = nullptr;      ///< nodes of the boundary may move; null: none does
  const SphereStencils* stencils = nullptr;  ///< VCVs given by hand; null: none
  /// Elements, ascending, that have targets for their edge_tetrahedra() besides, so that they do
  /// not turn over between their corners.
  std::span<const Index> guarded = {};
  const ElementRoles* roles = nullptr;  ///< of all elements; null: nothing is known of them
};

/// Targets of a volume mesh as the blend says: one for each tetrahedron, one for each corner of the
/// other elements (corner_tetrahedra()). The weights of an element sum to its own
/// (element_weight()); tetrahedra none of whose nodes can move are left out: they cannot change. A
/// target at an edge of a guarded element is the one that the regular element, or the mesh as
/// given, has there; there is none with `rest` where the mesh as given has it inverted.
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
/// alone; elements of some roles do not heed it: ignores_vcvs().
///
/// vcvs: may be null if they have no share. given: coordinates (#nodes by 3) of the mesh that the
/// shares `automatic` and `rest` refer to; may be null if those are zero. threads: 0 for all cores;
/// no result depends on it. urgent: elements that count four times as much under `automatic`, once
/// more for each time they are listed. Throws UsageError for shares that are negative or all zero;
/// MeshError if `rest` counts and the mesh has an inverted element.
CellTargets<3> volume_targets(const Topology& topology, const VolumeVcvs* vcvs,
                              const TargetBlend& blend, const Coordinates* given, int threads = 0,
                              std::span<const Index> urgent = {},
                              const VolumeTargetDetails& details = {});

}  // namespace winslow
