#pragma once

#include <imgui.h>

#include "gui/view/overlays/view_overlay.h"
#include "gui/view/tools/viewport.h"

namespace winslow::gui {

/// What is drawn over the mesh for the mouse's sake.
struct Overlay : ViewOverlay {
  const Viewport& viewport;
  const ViewportScene& scene;
};

/// Rings around nodes, the region outside which nothing moves, what is about to be moved or picked,
/// and what is held of the boundary.
void draw_overlay(ImDrawList& list, const Overlay& overlay);
/// The handle of the selection, that of a cut, and the point about which the view turns.
void draw_handles(ImDrawList& list, const Overlay& overlay);
/// Beside the mouse: the numbers of a drag, or what a handle or a click does.
void draw_mouse_labels(ImDrawList& list, const Overlay& overlay);

/// Columns and outlines of the layers that are planned; those cut short in another colour, with the
/// reason beside the mouse.
void draw_layer_preview(ImDrawList& list, const Overlay& overlay);

}  // namespace winslow::gui
