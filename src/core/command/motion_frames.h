#pragma once

#include "core/command/command.h"

namespace winslow {

/// Nodes that a command moves as rigid bodies, of each body: those of the markers that a
/// MoveCommand names and the mesh has. Empty for other commands.
std::vector<std::vector<Index>> moved_as_bodies(const Command& command, const Topology& topology);

/// Which meshes of the way of commands are drawn.
struct FrameChoice {
  int per_command = 0;  ///< at most so many of each command, evenly over its way; 0: all
  /// Asked after every iteration: true ends it all with Cancelled. Empty: nothing does.
  std::function<bool()> cancelled = {};
};

/// Meshes on the way of commands: the one they start from, then of each command those of its
/// iterations, of long solves after every second, fourth, ..., its result the last. Where bodies
/// move, meshes are put in between as meshes_between() makes them. Throws what execute() throws.
std::vector<Mesh> motion_frames(const std::vector<ResolvedCommand>& commands, MeshState state,
                                const FrameChoice& choice = {});

}  // namespace winslow
