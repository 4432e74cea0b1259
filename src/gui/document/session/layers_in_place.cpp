#include "gui/document/session/layers_in_place.h"

#include <algorithm>

namespace winslow::gui {

namespace {

/// 0: none are known.
int known_layers(const Session& session, const LayerWall& wall) {
  const auto stack = session.mesh().layers();
  return stack ? layer_count(*stack, *session.topology(), wall) : 0;
}

}  // namespace

bool all_held(const Session& session, const std::vector<LayerWall>& walls) {
  const auto stack = session.mesh().layers();
  return stack && stack->held && std::ranges::all_of(walls, [&](const LayerWall& wall) {
           return known_layers(session, wall) > 0;
         });
}

void limit_to_present_layers(const Session& session, LayersCommand& command) {
  for (LayerWall& wall : command.layers.walls) {
    const int known = known_layers(session, wall);
    if (known > 0)
      wall.spacing.count = known;
    else if (command.task == LayerTask::hold)
      wall.spacing.count = every_layer;
  }
}

}  // namespace winslow::gui
