#pragma once

#include <span>

#include "io/gmsh/gmsh.h"

namespace winslow::io::gmsh {

/// Makes markers and regions of the physical groups. offsets: where each of Details::items begins
/// in the file.
void collect_groups(std::span<const std::size_t> offsets, Details& details, ParsedMesh& mesh);

}  // namespace winslow::io::gmsh
