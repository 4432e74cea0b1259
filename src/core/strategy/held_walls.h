#pragma once

#include "core/layers/layer_plan.h"
#include "core/motion/motion.h"
#include "core/strategy/mesh_state.h"
#include "core/strategy/run.h"
#include "core/strategy/smooth_options.h"

/// Layers of volume meshes whose heights are held (in plane meshes: layering.h):
///
///     winslow::LayersCommand hold;
///     hold.task = winslow::LayerTask::hold;
///     hold.layers.walls = {{{"wing"}, {}}};
///     state = winslow::execute(hold, state).state;  // from now on motions hold the heights
///
/// Targets `keep` alone hold heights where there is room (WallStretch). A motion with held walls
/// makes the layers stiff, and then corrects their targets until the lengths of the edges up the
/// columns (layer_edges()) are those of the reference mesh.
namespace winslow {

/// Adds walls to those whose layers are held. Throws UsageError for an unknown marker, and for
/// walls without layers.
void hold_walls(std::span<const LayerWall> walls, MeshState& state);

/// Moves the boundary as smooth_motion() does, and then corrects the heights of the layers at the
/// held walls of the state until they are those of the reference mesh. A correction that lowers the
/// smallest scaled Jacobian by more than a tenth is not kept. Throws UsageError for targets without
/// a share `keep`, which know no reference mesh; else as smooth_motion().
SmoothResult move_with_held_walls(MeshState& state, const Motion& motion, const MotionOptions& how,
                                  const SmoothOptions& smooth, const RunOptions& run);

}  // namespace winslow
