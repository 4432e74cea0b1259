#pragma once

#include <iosfwd>
#include <nlohmann/json_fwd.hpp>

#include "core/quality/mesh_change.h"

namespace winslow::app {

/// First height, tilt and growth of the cells at walls, and the size ratio of neighbours: how they
/// are spread, and how they were. before: null where there was no other mesh.
void print_walls(std::ostream& out, const WallReport* before, const WallReport& now);

/// The block "walls" (docs/command-line.md lists the keys). mesh: that of `now`.
nlohmann::json describe_walls(const WallReport* before, const WallReport& now, const Mesh& mesh);

}  // namespace winslow::app
