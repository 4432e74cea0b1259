#pragma once

#include <map>
#include <span>
#include <string>
#include <vector>

#include "core/mesh/surface_faces.h"

namespace winslow {

/// The faces of sliding markers of a volume mesh, or the elements of a surface mesh, and which
/// nodes lie on the boundary that does not slide (#nodes, 1 or 0).
struct SlidingFaces {
  std::vector<SurfaceFace> faces;
  std::vector<unsigned char> stays;
};
/// markers: indices; of a surface mesh none are looked at.
SlidingFaces sliding_faces(const Topology& topology, std::span<const Index> markers);

/// For reports: of the marker of a face, -1 for none.
std::string part_name(const Topology& topology, Index marker);
/// The lowest marker of the faces at each node of some faces.
std::map<Index, Index> markers_at(std::span<const SurfaceFace> faces);

}  // namespace winslow
