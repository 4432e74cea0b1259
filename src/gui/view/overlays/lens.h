#pragma once

#include <imgui.h>

#include <optional>

#include "gui/render/camera.h"
#include "gui/view/mesh/mesh_view.h"
#include "gui/view/overlays/view_overlay.h"
#include "gui/view/tools/magnifier.h"

namespace winslow::gui {

/// The magnifier of a frame, of the window or of a picture. Its mesh is painted in the midst of the
/// interface: over what was drawn before it, under what comes after.
class Lens {
 public:
  explicit Lens(MeshView& mesh) : mesh_(mesh) {}
  Lens(const Lens&) = delete;  // draw lists know its address
  Lens& operator=(const Lens&) = delete;

  void place(std::optional<Inset> inset) { inset_ = std::move(inset); }
  /// None if nothing is magnified.
  const std::optional<Inset>& inset() const { return inset_; }
  /// The part of the frame that is painted next.
  void set_tile(const ScreenBox& tile) { tile_ = tile; }
  /// The lens must stay until the list is painted.
  void draw(ImDrawList& list, const ViewOverlay& overlay);

 private:
  void paint() const;

  MeshView& mesh_;
  std::optional<Inset> inset_;
  ScreenBox tile_;
};

}  // namespace winslow::gui
