#pragma once

#include <vector>

#include "core/mesh/topology.h"

namespace winslow {

/// The connected parts of a mesh's boundary as faces with the elements behind them: the loops of a
/// plane or surface mesh, walked along; of a volume mesh the surfaces whose faces hang together by
/// edges, in the order of their first faces.
std::vector<std::vector<Face>> boundary_parts(const Topology& topology);

}  // namespace winslow
