#pragma once

#include "core/command/command.h"

namespace winslow {

/// What an insertion plans its layers by.
LayerOptions options_of(const LayersCommand& command);

/// Carries out the command. Insertion: plans and inserts layers, makes room for them by pushing the
/// elements outside along a path of valid meshes, then smooths towards VCVs that ask for the wanted
/// heights, and corrects these until the heights are met. Layers that are inserted to
/// be held, or taken in hand, join those that are held at other walls. Throws UsageError,
/// Cancelled; NumericError if no room can be made.
CommandResult run_layers(const LayersCommand& command, const MeshState& state,
                         const ExecuteOptions& run);

/// Moves the boundary of a mesh whose state has layers that are held. Where walls come so near to
/// one another that there is no room, layers get thinner first, and heights that they gave up
/// return where there is room again. Afterwards the VCVs are corrected until the wanted heights
/// are met. Throws as smooth_motion().
CommandResult move_with_layers(const MeshState& state, const Motion& motion,
                               const MotionOptions& how, const SmoothOptions& smooth,
                               const ExecuteOptions& run);

}  // namespace winslow
