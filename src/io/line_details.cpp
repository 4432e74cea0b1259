#include "io/line_details.h"

#include <algorithm>

namespace winslow::io {

bool LineDetails::fits(const Mesh& mesh) const {
  const Topology& topology = *mesh.topology;
  if (nodes != topology.node_count() || elements != topology.element_count()) return false;
  if (!topology.markers_from_file()) return marker_lines.empty();
  const auto& markers = topology.markers();
  if (markers.size() != marker_lines.size()) return false;
  for (std::size_t m = 0; m < markers.size(); ++m) {
    const auto& own = marker_lines[m];
    const auto same_nodes = [&](Index line, const std::array<Index, 2>& edge) {
      return lines[static_cast<std::size_t>(line)] == edge;
    };
    if (!std::equal(own.begin(), own.end(), markers[m].edges.begin(), markers[m].edges.end(),
                    same_nodes)) {
      return false;
    }
  }
  return true;
}

}  // namespace winslow::io
