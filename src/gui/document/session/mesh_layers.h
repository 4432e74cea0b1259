#pragma once

#include "core/command/command.h"
#include "gui/document/actions/dispatch.h"
#include "gui/document/actions/document_actions.h"
#include "gui/document/jobs/wall_layers.h"
#include "gui/document/session/live_mesh.h"

namespace winslow::gui {

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

  void apply(const LayerAction& action) { Dispatch::to(*this, action); }
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
