#include "io/format/boundary_details.h"

#include <algorithm>

namespace winslow::io {

Face BoundaryDetails::face(Index coded) const {
  const Face& side = sides[static_cast<std::size_t>(coded < 0 ? ~coded : coded)];
  return coded < 0 ? side.reversed() : side;
}

bool BoundaryDetails::fits(const Mesh& mesh) const {
  const Topology& topology = *mesh.topology;
  if (nodes != topology.node_count() || elements != topology.element_count()) return false;
  if (!topology.markers().from_file()) return marker_sides.empty();
  const auto& markers = topology.markers();
  if (markers.size() != marker_sides.size()) return false;
  for (std::size_t m = 0; m < markers.size(); ++m) {
    const auto& own = marker_sides[m];
    const auto same_nodes = [&](Index coded, const Face& other) { return face(coded) == other; };
    if (!std::equal(own.begin(), own.end(), markers[m].faces.begin(), markers[m].faces.end(),
                    same_nodes)) {
      return false;
    }
  }
  return true;
}

}  // namespace winslow::io
