#pragma once

#include <span>

#include "core/mesh/coordinates.h"
#include "core/mesh/topology.h"

namespace winslow {

/// Adds step * direction (#free by 2) to the free nodes of x. Returns the longest move of a node,
/// in units of the mesh.
double advance(const Topology& topology, std::span<const double> direction, double step,
               Coordinates& x);

}  // namespace winslow
