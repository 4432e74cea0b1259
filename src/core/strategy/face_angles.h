#pragma once

#include "core/formulation/wall_stretch.h"
#include "core/strategy/mesh_state.h"
#include "core/strategy/run.h"
#include "core/strategy/smooth_options.h"

namespace winslow {

/// Keeps the angles of faces within what checkMesh of OpenFOAM asks for, after a motion of a volume
/// mesh with polyhedra, of which finite volume solvers are the users: internal faces must not lean
/// by more than 70 degrees (non-orthogonality, FiniteVolumes::orthogonality()).
///
///     const winslow::FaceAngles angles =
///         winslow::keep_face_angles(state, classes, options, wall_stretch, monitor, x);
///
/// Where faces lean by more in the mesh x, the solution of a run with targets `keep`, and by less
/// in the reference mesh, the free nodes around them move: the energy of the run, of these nodes
/// alone, and a penalty on the angles (FacePenalty) are minimised together by L-BFGS. The result
/// depends on x and the reference mesh alone, so not on how a motion was cut into steps. A result
/// is taken only if fewer faces lean than before, no element is inverted, and no other measure of
/// checkMesh has more faces or cells beyond its limit.
///
/// classes: which nodes move. wall_stretch: as for the targets of the run; null: no wall is
/// stretched. monitor: may cancel; null: none. x: the mesh on entry, the result on
/// return; valid. Throws Cancelled.
FaceAngles keep_face_angles(const MeshState& state, const NodeClasses& classes,
                            const SmoothOptions& options, const WallStretch* wall_stretch,
                            SolverMonitor* monitor, Coordinates& x);

}  // namespace winslow
