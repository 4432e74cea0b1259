#include "gui/document/session/mesh_layers.h"

#include "gui/document/jobs/wall_layers.h"

namespace winslow::gui {

namespace {

/// 0: none are known.
int known_layers(const LiveMesh& mesh, const LayerWall& wall) {
  const auto stack = mesh.layers();
  return stack ? layer_count(*stack, *mesh.topology(), wall) : 0;
}

}  // namespace

bool MeshLayers::all_held(const std::vector<LayerWall>& walls) const {
  const auto stack = mesh_.layers();
  return stack && stack->held && std::ranges::all_of(walls, [&](const LayerWall& wall) {
           return known_layers(mesh_, wall) > 0;
         });
}

void MeshLayers::limit_to_present(LayersCommand& command) const {
  for (LayerWall& wall : command.layers.walls) {
    const int known = known_layers(mesh_, wall);
    if (known > 0)
      wall.spacing.count = known;
    else if (command.task == LayerTask::hold)
      wall.spacing.count = every_layer;
  }
}

bool MeshLayers::poll() {
  // While the mesh is on its way there is none to look at.
  const Document* document = mesh_.in_motion() ? nullptr : mesh_.document();
  bool changed = preview_.update(document ? &document->state().mesh : nullptr);
  changed |= found_.update(document ? &document->state() : nullptr);
  return changed;
}

}  // namespace winslow::gui
