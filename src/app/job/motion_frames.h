#pragma once

#include <vector>

#include "core/command/command.h"

namespace winslow::app {

/// Meshes on the way of commands: the one they start from, then up to `per_command` of each command
/// evenly over its iterations, its result the last. Throws what execute() throws.
std::vector<Coordinates> motion_frames(const std::vector<Command>& commands, MeshState state,
                                       int per_command);

}  // namespace winslow::app
