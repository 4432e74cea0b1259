#pragma once

#include "core/geometry/periodic_pairs.h"
#include "core/mesh/mesh_data.h"
#include "io/format/mesh_file.h"

namespace winslow::io {

/// Completes what a reader has found of periodic sides: whose mesh it is, and whether its nodes
/// match. Pairs that do not get a fault, which says so.
void settle_periodicity(FormatDetails& details, const Mesh& mesh, const std::string& file);

/// "lower" and "upper", ...: the pairs of a file, each named once.
std::string named_pairs(const GivenPeriodicity& periodicity);

/// Sentences on pairs that matched in the file and do not match any more.
std::vector<std::string> stale_pairs(const FormatDetails& details, const Mesh& mesh);

/// For readers of formats that say how one periodic side is taken to the other.

/// Of a file that says angles in radians about x, then y, then z, about a centre, and a translation
/// after that.
RigidImage image_of(const Vec3& centre, const Vec3& angles, const Vec3& translation);
/// What takes the image back.
RigidImage inverse_of(const RigidImage& image);

/// The nodes of some faces, ascending.
std::vector<Index> nodes_of(std::span<const Face> faces);
double shortest_edge(std::span<const Face> faces, const Coordinates& x);

/// The node of the second side that an image takes each node of the first to, up to `near`; empty,
/// if it takes one to none of them, or two to one.
std::vector<PeriodicPair> matched(const RigidImage& image, std::span<const Index> first,
                                  std::span<const Index> second, const Coordinates& x, double near);

}  // namespace winslow::io
