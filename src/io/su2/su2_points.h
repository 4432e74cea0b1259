#pragma once

#include "io/format/parsed_mesh.h"
#include "io/su2/su2.h"
#include "io/su2/su2_lines.h"

namespace winslow::io::su2 {

/// Nodes of this mesh that a free-form deformation box of the file lists (FFD_SURFACE_POINTS=), by
/// marker and number, with where they lie. The box may stand in another zone's part of the file.
std::vector<BoxPoint> box_points(const Source& source, const ParsedMesh& mesh);

/// True if a node that a box lists lies elsewhere by now: the box is no longer right.
bool box_is_stale(const std::vector<BoxPoint>& points, const Coordinates& x);

/// Reads the lines of NPOIN=: x, y, of dimension 3 z, one after the other into `values`, #points by
/// dimension, and whatever follows, which as in SU2 means nothing. Adds the places of the lines.
/// Returns true if single numbers at the ends of lines do not count from 0.
bool read_points(LineReader& lines, int dimension, std::span<double> values,
                 std::vector<std::size_t>& places, Details& details);

}  // namespace winslow::io::su2
