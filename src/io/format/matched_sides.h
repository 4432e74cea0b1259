#pragma once

#include <span>
#include <vector>

#include "core/geometry/periodic_pairs.h"
#include "core/mesh/mesh_data.h"

/// For readers of formats that say how one periodic side is taken to the other.
namespace winslow::io {

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
