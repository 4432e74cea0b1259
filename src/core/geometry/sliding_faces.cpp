#include "core/geometry/sliding_faces.h"

#include <algorithm>

namespace winslow {

SlidingFaces sliding_faces(const Topology& topology, std::span<const Index> markers) {
  SlidingFaces out;
  out.stays.assign(at(topology.node_count()), 0);
  const bool surface = topology.cell_dimension() == 2;
  for (const SurfaceFace& face : boundary_faces(topology)) {
    if (surface || std::ranges::find(markers, face.marker) != markers.end())
      out.faces.push_back(face);
    else
      for (const Index node : face.nodes) out.stays[at(node)] = 1;
  }
  return out;
}

std::string part_name(const Topology& topology, Index marker) {
  return marker < 0 ? std::string("surface") : topology.markers()[at(marker)].name;
}

std::map<Index, Index> markers_at(std::span<const SurfaceFace> faces) {
  std::map<Index, Index> marker_at;
  for (const SurfaceFace& face : faces)
    for (const Index node : face.nodes) {
      const auto [place, is_new] = marker_at.try_emplace(node, face.marker);
      if (!is_new) place->second = std::min(place->second, face.marker);
    }
  return marker_at;
}

}  // namespace winslow
