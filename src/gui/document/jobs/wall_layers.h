#pragma once

#include "core/layers/layer_plan.h"
#include "core/layers/layer_spacing.h"
#include "core/layers/layer_stack.h"
#include "core/mesh/mesh.h"
#include "core/strategy/mesh_state.h"
#include "gui/base/background.h"

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

}  // namespace winslow::gui
