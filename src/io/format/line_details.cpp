#include "io/format/line_details.h"

#include <algorithm>

namespace winslow::io {

std::array<Index, 2> LineDetails::edge(Index coded) const {
  const auto& nodes_of = lines[static_cast<std::size_t>(coded < 0 ? ~coded : coded)];
  return coded < 0 ? std::array<Index, 2>{nodes_of[1], nodes_of[0]} : nodes_of;
}

bool LineDetails::fits(const Mesh& mesh) const {
  const Topology& topology = *mesh.topology;
  if (nodes != topology.node_count() || elements != topology.element_count()) return false;
  if (!topology.markers().from_file()) return marker_lines.empty();
  const auto& markers = topology.markers();
  if (markers.size() != marker_lines.size()) return false;
  for (std::size_t m = 0; m < markers.size(); ++m) {
    const auto& own = marker_lines[m];
    const auto same_nodes = [&](Index coded, const Face& face) {
      return edge(coded) == face.edge();
    };
    if (!std::equal(own.begin(), own.end(), markers[m].faces.begin(), markers[m].faces.end(),
                    same_nodes)) {
      return false;
    }
  }
  return true;
}

}  // namespace winslow::io
