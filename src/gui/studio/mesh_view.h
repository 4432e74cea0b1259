#pragma once

#include <cstdint>
#include <optional>

#include "gui/render/backdrop.h"
#include "gui/render/camera.h"
#include "gui/render/mesh_renderer.h"
#include "gui/studio/session.h"
#include "gui/studio/view_options.h"
#include "gui/widgets/legend.h"

namespace winslow::gui {

/// Keeps the renderer in step with the session: mesh, colours, markers. Uploads only what changed.
class MeshView {
 public:
  void update(const Session& session, const ViewOptions& view, float scale);
  /// Draws into the bound framebuffer, `height` pixels high.
  void draw(const Camera& camera, int width, int height, bool backdrop = true);
  /// Of the colours now shown; none if elements are plain.
  const std::optional<Legend>& legend() const { return legend_; }

 private:
  void update_colors(const Session& session, const ViewOptions& view);
  void update_markers(const Session& session, const ViewOptions& view, float scale);

  MeshRenderer renderer_;
  MeshStyle style_;
  BackdropColors backdrop_;
  std::optional<Legend> legend_;
  bool has_mesh_ = false;
  std::uint64_t generation_ = 0, shape_ = 0;
  std::shared_ptr<const QualityMonitor::Measured> colored_;  // what the colours show
  ViewOptions colored_view_;
};

}  // namespace winslow::gui
