#pragma once

#include "core/command/command.h"

namespace winslow {

/// The nodes of each body that a MoveCommand moves rigidly: those of its markers that the mesh has.
/// Empty for other commands.
std::vector<std::vector<Index>> moved_as_bodies(const Command& command, const Topology& topology);

/// Which intermediate meshes of commands are drawn.
struct FrameChoice {
  int per_command = 0;  ///< most meshes per command, evenly distributed; 0: all
  /// Called after every iteration: true ends the computation with Cancelled. Empty: never
  /// cancelled.
  std::function<bool()> cancelled = {};
};

/// The meshes of a sequence of commands: the initial mesh, then for each command the meshes of its
/// iterations and its result. For long solves only every second, fourth, ... iteration is included.
/// For moving bodies, meshes_between() interpolates further meshes. Throws what execute() throws.
std::vector<Mesh> motion_frames(const std::vector<ResolvedCommand>& commands, MeshState state,
                                const FrameChoice& choice = {});

}  // namespace winslow
