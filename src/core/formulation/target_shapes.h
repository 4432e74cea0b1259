#pragma once

#include "core/formulation/cell_targets.h"
#include "core/formulation/wall_stretch.h"
#include "core/mesh/coordinates.h"
#include "core/mesh/topology.h"
#include "core/types.h"
#include "core/vcv/sphere/volume_vcvs.h"
#include "core/vcv/virtual_control_volumes.h"

namespace winslow {

/// What single elements are besides their shapes.
struct ElementDetails {
  const ElementRoles* roles = nullptr;  ///< of all elements; null: all ordinary
  /// For the share `keep`; null: no wall is stretched.
  const WallStretch* wall_stretch = nullptr;
  /// For the targets of some elements: CellTargets::without_shape is not 0.
  bool any_without_shape = false;
};

/// All targets of a plane mesh or a surface mesh: triangles, and corners of quadrilaterals, each
/// with one or more terms. The terms of an element have weights that sum to its own
/// (element_weight()), however many of its nodes lie at the boundary.
/// Triangles without a movable node are omitted.
///
/// An edited VCV (VirtualControlVolumes::edited) takes effect in every blend: in the corners at its
/// node the VCV gets the shares `automatic` and `element`. If the blend has no `vcv` share, a
/// triangle with such corners has only their targets. In a quadrilateral with such corners, a
/// corner at the boundary gets the parallelogram of their targets. Elements with some roles ignore
/// edited VCVs: ignores_vcvs().
struct TargetShapes : CellTargets<2> {
  /// Makes the targets for a blend. given: coordinates of the mesh to which the shares `automatic`
  /// and `rest` refer; may be null if those are zero. threads: 0 for all cores. urgent: elements
  /// whose weight under `automatic` is multiplied by four for each time they are listed. classes:
  /// which nodes move; null: only interior nodes. normals: for a surface mesh, those of its
  /// elements in the mesh as given (ElementNormals); needed if `given` is. Throws UsageError for
  /// shares that are negative or all zero, MeshError if `rest` counts and the mesh has an inverted
  /// element.
  static TargetShapes build(const VirtualControlVolumes& vcv, const TargetBlend& blend,
                            const Coordinates* given, int threads = 0,
                            std::span<const Index> urgent = {},
                            const NodeClasses* classes = nullptr,
                            std::span<const Vec3> normals = {}, const ElementDetails& details = {});
  /// Those of some elements (ascending) of a plane mesh.
  static TargetsOfSome<2> build_some(std::span<const Index> elements,
                                     const VirtualControlVolumes& vcv, const TargetBlend& blend,
                                     const Coordinates* given, int threads,
                                     std::span<const Index> urgent, const NodeClasses* classes,
                                     const ElementDetails& details);
};

/// Properties of single nodes and elements.
struct VolumeTargetDetails {
  const NodeClasses* classes = nullptr;      ///< which nodes move; null: only interior ones
  const SphereStencils* stencils = nullptr;  ///< VCVs given by hand; null: none
  /// Elements, ascending, with additional targets for their edge_tetrahedra(), so that they do not
  /// invert between their corners.
  std::span<const Index> guarded = {};
  const ElementRoles* roles = nullptr;  ///< of all elements; null: all ordinary
  /// For the share `keep`; null: no wall is stretched.
  const WallStretch* wall_stretch = nullptr;
  /// Coordinates (#nodes by 3) in which elements with the role `layer` or `found_layer` have the
  /// shapes that are their targets in every blend; null: their targets are like those of others.
  const Coordinates* layer_shapes = nullptr;
  /// For the targets of some elements: CellTargets::without_shape is not 0.
  bool any_without_shape = false;
};

/// Targets of a volume mesh as the blend says: one for each tetrahedron, one for each corner of the
/// other elements (corner_tetrahedra()). The weights of an element's targets sum to
/// element_weight(); tetrahedra without a movable node are omitted. A target at an edge of a
/// guarded element is that of the regular element or of the mesh as given; with `rest` there is
/// none if it is inverted in the mesh as given.
///
/// `element`: the corners of the regular element of the type. `rest`: the element's own corners in
/// the mesh as given. `automatic`: between these, by StretchField. `vcv`: a tetrahedron has one
/// target for each of its interior nodes, the corresponding tetrahedron of the node's VCV (node,
/// three neighbours), blended with the other shares. A corner of another element has the target of
/// its node's VCV, or the regular one if the node is on the boundary.
///
/// A VCV given by hand (stencils; vcvs contain them, too) takes effect in every blend, as in the
/// plane: in the targets at its node the VCV gets the shares `automatic` and `element`. If the
/// blend has no `vcv` share, a tetrahedron with such nodes has only the targets at these. Elements
/// with some roles ignore it: ignores_vcvs().
///
/// vcvs: may be null if the `vcv` share is zero. given: coordinates (#nodes by 3) of the mesh to
/// which the shares `automatic` and `rest` refer; may be null if those are zero. threads: 0 for all
/// cores; no result depends on it. urgent: elements whose weight under `automatic` is multiplied by
/// four for each time they are listed. Throws UsageError for shares that are negative or all zero,
/// and for an element of layers that is inverted or flat in its layer_shapes; MeshError if `rest`
/// counts and the mesh has an inverted element.
CellTargets<3> volume_targets(const Topology& topology, const VolumeVcvs* vcvs,
                              const TargetBlend& blend, const Coordinates* given, int threads = 0,
                              std::span<const Index> urgent = {},
                              const VolumeTargetDetails& details = {});
/// Those of some elements (ascending).
TargetsOfSome<3> volume_targets_of(std::span<const Index> elements, const Topology& topology,
                                   const VolumeVcvs* vcvs, const TargetBlend& blend,
                                   const Coordinates* given, int threads,
                                   std::span<const Index> urgent,
                                   const VolumeTargetDetails& details);

}  // namespace winslow
