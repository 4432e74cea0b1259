#pragma once

#include "core/mesh/coordinates.h"
#include "core/mesh/topology.h"

namespace winslow {

/// Mean length of the edges at a node, in units of the mesh.
double mean_edge(const Topology& topology, const Coordinates& x, Index node);

/// Smallest scaled residual (ResidualNorms::max) that double precision can show on this mesh:
/// residuals are differences of coordinates over edge lengths, so they carry the round-off of the
/// coordinates in units of the edges.
double residual_round_off(const Topology& topology, const Coordinates& x);

}  // namespace winslow
