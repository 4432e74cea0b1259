#include "gui/document/jobs/found_layers.h"

#include <algorithm>
#include <exception>
#include <utility>

#include "core/layers/layer_detection.h"
#include "gui/document/jobs/wall_layers.h"

namespace winslow::gui {

FoundLayers::Outcome FoundLayers::look(const Mesh& mesh) {
  Outcome outcome{mesh.topology, {}};
  LayerOptions options;
  for (const Marker& marker : mesh.topology->markers()) {
    LayerWall wall{{marker.name}, {}};
    if (!may_have_layers(*mesh.topology, {wall})) continue;
    wall.spacing.count = every_layer;
    options.walls.push_back(std::move(wall));
  }
  if (options.walls.empty()) return outcome;
  try {
    const LayerStack stack = detect_layers(mesh, options);
    for (const LayerWall& wall : options.walls)
      if (const int count = layer_count(stack, *mesh.topology, wall); count > 0)
        outcome.found[wall.markers.front()] = count;
  } catch (const std::exception&) {
    // Quadrilaterals that are no layers: nothing is found, and holding them would say why.
    outcome.found.clear();
  }
  return outcome;
}

bool FoundLayers::update(const MeshState* state) {
  bool news = false;
  if (auto outcome = worker_.poll()) {
    news = outcome->topology == topology_;
    if (news) found_ = std::move(outcome->found);
  }
  if (!state || worker_.busy() || state->mesh.topology == topology_) return news;
  topology_ = state->mesh.topology;
  found_.clear();
  worker_.start([mesh = state->mesh] { return look(mesh); });
  return true;
}

}  // namespace winslow::gui
