#pragma once

#include "core/sensitivity/target_response.h"
#include "core/strategy/mesh_state.h"

namespace winslow {

/// What the targets of a motion with held layers in the plane are made of.
struct HeldLayerTargets {
  const MeshState& result;  ///< of the motion: layers, VCVs and roles
  const TargetBlend& targets;
  const NodeClasses& classes;
  const Coordinates& reference;
  int threads = 1;
};

/// How the gradient of the energy depends on the walls through the VCVs of held layers
/// (layer_vcvs()): where a wall is stretched, its layers are to be as long as the wall, and as high
/// as they were. The corrections of the heights are constant. The derivative by the nodes of the
/// walls is computed once, by central differences of the targets.
///
/// form: at its solution x. Null if the VCVs of the result are not those of its walls: heights that
/// were right after the motion had no correction, and the VCVs are those of an earlier mesh.
std::unique_ptr<const TargetResponse> layer_response(const VariationalWinslow& form,
                                                     const HeldLayerTargets& of,
                                                     const Coordinates& x);

}  // namespace winslow
