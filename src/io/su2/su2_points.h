#pragma once

#include "io/format/parsed_mesh.h"
#include "io/su2/su2.h"
#include "io/su2/su2_lines.h"

namespace winslow::io::su2 {

/// Reads the lines of NPOIN= into the mesh: x, y, of dimension 3 z, and whatever follows, which as
/// in SU2 means nothing. Returns true if single numbers at the ends of lines do not count from 0.
bool read_points(LineReader& lines, Index count, int dimension, ParsedMesh& mesh, Details& details);

}  // namespace winslow::io::su2
