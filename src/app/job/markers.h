#pragma once

#include "core/command/command.h"

namespace winslow::app {

/// Throws UsageError for a marker that the mesh does not have; the message suggests the nearest and
/// lists what there is. `file` is the mesh's name for the message.
void check_markers(const std::vector<Command>& commands, const Topology& topology,
                   const std::string& file);
/// The same for a marker that none of several meshes has.
void check_markers(const std::vector<Command>& commands,
                   const std::vector<const Topology*>& topologies, const std::string& file);

}  // namespace winslow::app
