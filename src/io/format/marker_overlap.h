#pragma once

#include <string>
#include <vector>

#include "core/mesh/mesh.h"

namespace winslow::io {

/// Sentences about edges that a marker names twice, or that two markers share: no error, but
/// solvers take only one boundary condition for an edge.
std::vector<std::string> marker_overlaps(const Topology& topology);

}  // namespace winslow::io
