#pragma once

#include <filesystem>
#include <memory>

#include "core/command/command.h"
#include "core/geometry/reference_surface.h"

namespace winslow::io {

/// Reads a surface mesh, or what bounds a volume mesh, of any format (read_mesh()) to slide on.
/// Throws InputError as read_mesh() does.
std::shared_ptr<const ReferenceSurface> read_reference(const std::filesystem::path& path);

/// Reads the reference surface that a command names, if it does and has not got it yet.
void load_reference(Command& command);

}  // namespace winslow::io
