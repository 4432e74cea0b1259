#pragma once

#include "core/geometry/periodic_pairs.h"
#include "core/mesh/mesh_data.h"
#include "io/format/mesh_file.h"

namespace winslow::io {

/// Completes the periodic sides that a reader has found: sets their mesh and checks that the nodes
/// match. A pair whose nodes do not match gets a fault that says so.
void settle_periodicity(FormatDetails& details, const Mesh& mesh, const std::string& file);

/// "lower" and "upper", ...: the pairs of a file, each named once.
std::string named_pairs(const GivenPeriodicity& periodicity);

/// Sentences about pairs that matched in the file but no longer match.
std::vector<std::string> stale_pairs(const FormatDetails& details, const Mesh& mesh);

/// The functions below are for readers of formats that give the transformation between periodic
/// sides.

/// The transformation of a file that gives rotations about x, then y, then z (radians) about a
/// centre, then a translation.
RigidImage image_of(const Vec3& centre, const Vec3& angles, const Vec3& translation);
/// The inverse transformation.
RigidImage inverse_of(const RigidImage& image);

/// The nodes of some faces, ascending.
std::vector<Index> nodes_of(std::span<const Face> faces);
double shortest_edge(std::span<const Face> faces, const Coordinates& x);

/// Pairs each node of the first side with the node of the second side at its image, up to `near`.
/// Empty if a node has no partner or two nodes have the same one.
std::vector<PeriodicPair> matched(const RigidImage& image, std::span<const Index> first,
                                  std::span<const Index> second, const Coordinates& x, double near);

}  // namespace winslow::io
