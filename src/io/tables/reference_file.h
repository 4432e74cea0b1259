#pragma once

#include <filesystem>
#include <memory>

#include "core/command/command.h"
#include "core/geometry/sliding_boundary.h"
#include "io/format/mesh_file.h"

namespace winslow::io {

/// Reads a surface mesh, or what bounds a volume mesh, of any format (read_mesh()) to slide on.
/// Throws InputError as read_mesh() does.
std::shared_ptr<const ReferenceSurface> read_reference(const std::filesystem::path& path);

/// Reads the reference surface that a command names, if it does and has not got it yet.
void load_reference(Command& command);

/// Tells a command what the file of its mesh says of periodic sides, for those that want its pairs.
/// details: null for a mesh that came from no file.
void give_pairs(Command& command, const FormatDetails* details);

}  // namespace winslow::io
