#pragma once

#include "core/geometry/periodic_pairs.h"
#include "core/mesh/mesh_data.h"
#include "io/cgns/zone_markers.h"
#include "io/cgns/zones.h"

namespace winslow::io::cgns {

/// True for a connection with Periodic_t.
bool is_periodic(const NodeView& connection);
/// The zone that a connection leads to is this one: "Zone" or "Base/Zone".
bool leads_to(const NodeView& connection, const std::string& zone);

/// Pairs of nodes that a connection names vertex by vertex; empty: it does not.
using VertexPairs = std::function<std::vector<PeriodicPair>(const NodeView& connection)>;
/// Of an unstructured zone: PointList, PointListDonor and the like at vertices.
std::vector<PeriodicPair> listed_pairs(const NodeView& connection, std::int64_t vertices);

/// Periodic sides of the zone: its connections to itself with Periodic_t, as pairs of the markers
/// that lie on their sides. Where a connection names no pairs of vertices but faces, these are
/// matched by what Periodic_t says of rotation and translation. One that cannot be used is a
/// sentence in `warnings`.
std::vector<GivenPairs> periodic_pairs(const NodeView& zone, const ZoneHead& head,
                                       const ZoneBoundary& boundary, const VertexPairs& pairs_of,
                                       const MeshData& mesh, std::vector<std::string>& warnings);

}  // namespace winslow::io::cgns
