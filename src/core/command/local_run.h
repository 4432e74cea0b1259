#pragma once

#include "core/command/command.h"
#include "core/mesh/mesh.h"

namespace winslow {

/// The command said in the coordinates of a frame: pivots, places of displacements, boxes of walls.
Command in_frame(Command command, const LocalFrame& frame);

using CarryOut = std::function<CommandResult(const Command&, const MeshState&, const RunOptions&)>;

/// Carries out a command in the coordinates of a frame; start, meshes on the way and result are in
/// those of the state. Throws what `carry_out` throws.
CommandResult run_in_frame(const LocalFrame& frame, const Command& command, const MeshState& state,
                           const RunOptions& options, const CarryOut& carry_out);

}  // namespace winslow
