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

/// After a change of a mesh whose state has layers: corrects the VCVs until the wanted heights are
/// met again. Counts and history of the result are those of all smoothing.
CommandResult hold_spacing(CommandResult result, const SmoothOptions& smooth,
                           const ExecuteOptions& run);

}  // namespace winslow
