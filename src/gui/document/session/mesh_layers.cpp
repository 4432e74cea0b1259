#include "gui/document/session/mesh_layers.h"

#include "core/layers/layer_detection.h"
#include "core/layers/layer_plan.h"

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
    // The quadrilaterals form no layers: report none here; a command that holds them explains why.
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

bool LayerPreview::update(const Mesh* mesh) {
  bool news = false;
  if (auto outcome = worker_.poll()) {
    done_ = std::move(*outcome);
    made_ = making_;
    news = true;
  }
  key_ = mesh ? mesh->coordinates.values().data() : nullptr;
  present_ = key_ && key_ == made_;
  if (!mesh || !wanted_ || fits() || worker_.busy()) return news;
  making_ = key_;
  worker_.start([mesh = *mesh, options = *wanted_] {
    Outcome outcome{mesh, options, nullptr, {}};
    outcome.error = error_of([&] {
      outcome.plan =
          std::make_shared<const LayerStack>(sound_plan(mesh, with_counts(options, mesh)));
    });
    return outcome;
  });
  return news;
}

namespace {

/// Number of known layers; 0: none.
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
  // While the mesh is in motion there is no mesh to search.
  const Document* document = mesh_.in_motion() ? nullptr : mesh_.document();
  bool changed = preview_.update(document ? &document->state().mesh : nullptr);
  changed |= found_.update(document ? &document->state() : nullptr);
  return changed;
}

}  // namespace winslow::gui
