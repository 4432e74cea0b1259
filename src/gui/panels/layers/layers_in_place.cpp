#include "gui/panels/layers/layers_in_place.h"

#include <algorithm>

namespace winslow::gui {

namespace {

/// The most layers that a column on the wall is known to have; 0: none are known.
int known_layers(const Session& session, const LayerWall& wall) {
  const auto stack = session.layers();
  if (!stack) return 0;
  const auto nodes = session.topology()->markers().nodes_of(wall.markers);
  std::size_t most = 0;
  for (const LayerColumn& column : stack->columns)
    if (std::ranges::binary_search(nodes, column.wall_node)) most = std::max(most, column.count());
  return static_cast<int>(most);
}

}  // namespace

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

bool all_held(const Session& session, const std::vector<LayerWall>& walls) {
  const auto stack = session.layers();
  return stack && stack->held && std::ranges::all_of(walls, [&](const LayerWall& wall) {
           return known_layers(session, wall) > 0;
         });
}

void limit_to_present_layers(const Session& session, LayersCommand& command) {
  constexpr int all = 1000;
  for (LayerWall& wall : command.layers.walls) {
    const int known = known_layers(session, wall);
    if (known > 0)
      wall.spacing.count = known;
    else if (command.task == LayerTask::hold)
      wall.spacing.count = all;
  }
}

}  // namespace winslow::gui
