#pragma once

#include <map>
#include <memory>
#include <string>

#include "core/strategy/mesh_state.h"
#include "gui/base/background.h"

namespace winslow::gui {

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

}  // namespace winslow::gui
