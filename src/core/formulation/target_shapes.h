#pragma once

#include "core/formulation/cell_targets.h"
#include "core/formulation/element_roles.h"
#include "core/mesh/coordinates.h"
#include "core/problem/node_classes.h"
#include "core/types.h"
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

}  // namespace winslow
