#pragma once

#include <filesystem>

#include "core/motion/motion.h"

/// Displacements from a file:
///
///     winslow::DeformCommand deform;
///     deform.markers = {"wing"};
///     deform.shape = winslow::io::read_displacements("displacements.csv");
namespace winslow::io {

/// Reads a CSV file of displacements (separators: comma, semicolon, tab or blanks; '#' starts a
/// comment). A first line of names, among node (or id), x, y, z, dx, dy, dz, says what the columns
/// are and others are skipped; z and dz are for volume meshes. Without it three columns are node,
/// dx, dy, four are x, y, dx, dy and six are x, y, z, dx, dy, dz. Nodes count from 0; lengths are
/// in the unit of the mesh. Throws InputError "FILE:LINE: found ..., expected ...".
DisplacementTable read_displacements(const std::filesystem::path& path);

}  // namespace winslow::io
