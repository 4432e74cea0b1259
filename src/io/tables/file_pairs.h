#pragma once

#include "core/command/command.h"
#include "io/format/mesh_file.h"

namespace winslow::io {

/// Tells a command what the file of its mesh says of periodic sides, for those that want its pairs.
/// details: null for a mesh that came from no file.
void give_pairs(Command& command, const FormatDetails* details);

}  // namespace winslow::io
