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

/// More layers than any wall has: all that there are.
inline constexpr int every_layer = 1000;

/// Quadrilaterals stand on one of the walls.
bool may_have_layers(const Topology& topology, const std::vector<LayerWall>& walls);
/// The most layers that a column of the stack on the wall has.
int layer_count(const LayerStack& stack, const Topology& topology, const LayerWall& wall);

/// Layers of a mesh that nobody has inserted or held yet: those that came with its file. Looked for
/// in the background, once per connectivity.
class FoundLayers {
 public:
  /// state: the mesh to look at; null: none now. True if something new is known.
  bool update(const MeshState* state);
  bool busy() const { return worker_.busy(); }
  /// All is known of a mesh of this connectivity.
  bool looked_at(const std::shared_ptr<const Topology>& topology) const {
    return topology_ == topology && !worker_.busy();
  }
  /// The most layers that a column on each marker has, by the marker's name; markers without any
  /// are left out.
  const std::map<std::string, int>& at_markers() const { return found_; }

 private:
  struct Outcome {
    std::shared_ptr<const Topology> topology;
    std::map<std::string, int> found;
  };
  static Outcome look(const Mesh& mesh);

  std::shared_ptr<const Topology> topology_;  // of what was looked at last
  std::map<std::string, int> found_;
  Background<Outcome> worker_;
};

/// The plan of layers that are asked for but not inserted yet, made behind the frame loop's back.
class LayerPreview {
 public:
  /// Options to plan for; none: nothing is shown.
  void want(std::optional<LayerOptions> options) { wanted_ = std::move(options); }
  const std::optional<LayerOptions>& wanted() const { return wanted_; }
  /// In every frame. mesh: to plan on; null: there is none, or it is moving. True if there is news.
  bool update(const Mesh* mesh);
  bool busy() const { return worker_.busy(); }

  /// Of the options wanted on the mesh of the last update; null until it is there.
  const LayerStack* plan() const { return fits() ? done_.plan.get() : nullptr; }
  /// Where that plan stands.
  const Coordinates& coordinates() const { return done_.mesh.coordinates; }
  /// Why there is no plan; empty: there is one, or it is under way.
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
  const void* key_ = nullptr;   // that mesh's numbers
  const void* made_ = nullptr;  // those of done_
  const void* making_ = nullptr;
  Outcome done_;
  Background<Outcome> worker_;
};

/// Layers at the walls of the mesh of the history: those that it has, and those that are planned.
class MeshLayers {
 public:
  explicit MeshLayers(const LiveMesh& mesh) : mesh_(mesh) {}

  /// Layers that are planned and not inserted.
  const LayerPreview& preview() const { return preview_; }
  /// Layers that came with the mesh.
  const FoundLayers& found() const { return found_; }
  /// The layers of all these walls are held.
  bool all_held(const std::vector<LayerWall>& walls) const;
  /// Sets how many layers of each wall a command works on: those that are known to be there. Of
  /// a wall without known ones: all that are found, to hold them; to space them anew, what the
  /// wall's spacing says.
  void limit_to_present(LayersCommand& command) const;

  void on(const action::PreviewLayers& a) { preview_.want(a.options); }
  /// The mesh goes: nothing is planned any more.
  void forget_mesh() { preview_.want({}); }
  /// Collects what the threads have done since the last call. True if anything changed.
  bool poll();
  bool busy() const { return preview_.busy() || found_.busy(); }

 private:
  const LiveMesh& mesh_;
  LayerPreview preview_;
  FoundLayers found_;
};

}  // namespace winslow::gui
