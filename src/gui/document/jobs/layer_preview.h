#pragma once

#include <memory>
#include <optional>
#include <string>

#include "core/layers/layer_plan.h"
#include "gui/base/background.h"

namespace winslow::gui {

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
