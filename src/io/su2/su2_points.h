#pragma once

#include <span>
#include <vector>

#include "io/su2/su2.h"
#include "io/su2/su2_lines.h"

namespace winslow::io::su2 {

/// Reads the lines of NPOIN=: x, y, of dimension 3 z, one after the other into `values`, #points by
/// dimension, and whatever follows, which as in SU2 means nothing. Adds the places of the lines.
/// Returns true if single numbers at the ends of lines do not count from 0.
bool read_points(LineReader& lines, int dimension, std::span<double> values,
                 std::vector<std::size_t>& places, Details& details);

}  // namespace winslow::io::su2
