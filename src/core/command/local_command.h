#pragma once

#include "core/command/command.h"
#include "core/strategy/smooth_run.h"

/// Commands in coordinates near the mesh: execute() carries out commands on a mesh far from the
/// origin by carry_out_in().
namespace winslow {

/// Carries out a command on a state in the state's own coordinates.
using CarryOut = std::function<CommandResult(const Command& command, const MeshState& state,
                                             const RunOptions& options)>;

/// Executes a command in the coordinates of a frame; start, intermediate meshes and result are in
/// those of the state. Throws as carry_out() does.
CommandResult carry_out_in(const LocalFrame& frame, const Command& command, const MeshState& state,
                           const RunOptions& options, const CarryOut& carry_out);

/// The equations of which the result of a motion is the solution, in coordinates near the mesh. For
/// MeshSensitivity. moved: the result of the motion. Its mesh may be any mesh near that; held
/// layers keep the corrections that it has. Throws UsageError for a command that is no motion or
/// does not smooth, for a result with other nodes or elements, and what execute() throws.
MotionEquations equations_of(const ResolvedCommand& command, const MeshState& state,
                             const CommandResult& moved, const RunOptions& options);

}  // namespace winslow
