#pragma once

#include <vector>

#include "io/format/parsed_mesh.h"
#include "io/su2/su2.h"

namespace winslow::io::su2 {

/// Nodes of this mesh that a free-form deformation box of the file lists (FFD_SURFACE_POINTS=), by
/// marker and number, with where they lie. The box may stand in another zone's part of the file.
std::vector<BoxPoint> box_points(const Source& source, const ParsedMesh& mesh);

/// True if a node that a box lists lies elsewhere by now: the box is no longer right.
bool box_is_stale(const std::vector<BoxPoint>& points, const Coordinates& x);

}  // namespace winslow::io::su2
