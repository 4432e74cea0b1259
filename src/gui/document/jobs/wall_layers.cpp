#include "gui/document/jobs/wall_layers.h"

#include <algorithm>

namespace winslow::gui {

bool may_have_layers(const Topology& topology, const std::vector<LayerWall>& walls) {
  const auto on_quadrilateral = [&](const Face& edge) {
    return std::ranges::any_of(topology.star(edge[0]), [&](Index element) {
      return topology.element_type(element) == ElementType::quadrilateral;
    });
  };
  for (const LayerWall& wall : walls)
    for (const std::string& name : wall.markers) {
      const auto marker = topology.markers().find(name);
      if (!marker) continue;
      const auto& edges = topology.markers()[static_cast<std::size_t>(*marker)].faces;
      if (std::ranges::any_of(edges, on_quadrilateral)) return true;
    }
  return false;
}

int layer_count(const LayerStack& stack, const Topology& topology, const LayerWall& wall) {
  const auto nodes = topology.markers().nodes_of(wall.markers);
  std::size_t most = 0;
  for (const LayerColumn& column : stack.columns)
    if (std::ranges::binary_search(nodes, column.wall_node)) most = std::max(most, column.count());
  return static_cast<int>(most);
}

}  // namespace winslow::gui
