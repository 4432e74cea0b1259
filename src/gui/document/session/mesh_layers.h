#pragma once

#include "core/command/command.h"
#include "core/layers/layer_plan.h"
#include "core/layers/layer_spacing.h"
#include "core/layers/layer_stack.h"
#include "core/mesh/mesh.h"
#include "core/strategy/mesh_state.h"
#include "gui/base/background.h"
#include "gui/document/actions/document_actions.h"
#include "gui/document/session/live_mesh.h"

namespace winslow::gui {

/// More layers than any wall has; stands for all layers.
inline constexpr int every_layer = 1000;

/// True if quadrilaterals are adjacent to one of the walls.
bool may_have_layers(const Topology& topology, const std::vector<LayerWall>& walls);
/// The largest number of layers of a column of the stack on the wall.
int layer_count(const LayerStack& stack, const Topology& topology, const LayerWall& wall);

/// Finds layers of a mesh that were neither inserted nor held yet, that is, those of its file.
/// Searches in the background, once per connectivity.
class FoundLayers {
 public:
  /// state: the mesh to search; null: none. True if there is a new result.
  bool update(const MeshState* state);
  bool busy() const { return worker_.busy(); }
  /// The search of a mesh of this connectivity is complete.
  bool looked_at(const std::shared_ptr<const Topology>& topology) const {
    return topology_ == topology && !worker_.busy();
  }
  /// The largest number of layers of a column on each marker, by the marker's name; markers without
  /// layers are omitted.
  const std::map<std::string, int>& at_markers() const { return found_; }

 private:
  struct Outcome {
    std::shared_ptr<const Topology> topology;
    std::map<std::string, int> found;
  };
  static Outcome look(const Mesh& mesh);

  std::shared_ptr<const Topology> topology_;  // of the mesh searched last
  std::map<std::string, int> found_;
  Background<Outcome> worker_;
};

/// Plans layers before they are inserted, in the background.
class LayerPreview {
 public:
  /// Sets the options to plan for; none: nothing is shown.
  void want(std::optional<LayerOptions> options) { wanted_ = std::move(options); }
  const std::optional<LayerOptions>& wanted() const { return wanted_; }
  /// Call it in every frame. mesh: to plan on; null: none, or it is moving. True if there is news.
  bool update(const Mesh* mesh);
  bool busy() const { return worker_.busy(); }

  /// Plan for the wanted options on the mesh of the last update; null until it is ready.
  const LayerStack* plan() const { return fits() ? done_.plan.get() : nullptr; }
  /// Coordinates of the mesh of that plan.
  const Coordinates& coordinates() const { return done_.mesh.coordinates; }
  /// Why there is no plan; empty: there is one, or it is being made.
  std::string error() const { return fits() ? done_.error : std::string(); }

 private:
  struct Outcome {
    Mesh mesh;
    std::optional<LayerOptions> options;
    std::shared_ptr<const LayerStack> plan;
    std::string error;
  };
  bool fits() const { return present_ && wanted_ && done_.options == wanted_; }

  std::optional<LayerOptions> wanted_;
  bool present_ = false;        // done_ is of the mesh of the last update
  const void* key_ = nullptr;   // identity of that mesh
  const void* made_ = nullptr;  // that of done_
  const void* making_ = nullptr;
  Outcome done_;
  Background<Outcome> worker_;
};

/// Layers at the walls of the history's mesh, existing and planned.
class MeshLayers {
 public:
  explicit MeshLayers(const LiveMesh& mesh) : mesh_(mesh) {}

  /// Layers planned but not inserted.
  const LayerPreview& preview() const { return preview_; }
  /// Layers contained in the file of the mesh.
  const FoundLayers& found() const { return found_; }
  /// True if the layers of all these walls are held.
  bool all_held(const std::vector<LayerWall>& walls) const;
  /// Limits a command to the layers that each wall is known to have. For a wall without known
  /// layers: a command that holds them includes all it finds, a command that respaces them uses the
  /// number in the wall's spacing.
  void limit_to_present(LayersCommand& command) const;

  void on(const action::PreviewLayers& a) { preview_.want(a.options); }
  /// Drops the plan, since the mesh is being closed.
  void forget_mesh() { preview_.want({}); }
  /// Collects the threads' results since the last call. True if anything changed.
  bool poll();
  bool busy() const { return preview_.busy() || found_.busy(); }

 private:
  const LiveMesh& mesh_;
  LayerPreview preview_;
  FoundLayers found_;
};

}  // namespace winslow::gui
