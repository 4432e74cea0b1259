#pragma once

#include <imgui.h>

#include "gui/view/overlays/view_overlay.h"
#include "gui/view/tools/viewport.h"

namespace winslow::gui {

/// Data for the feedback to the mouse that is drawn over the mesh.
struct Overlay : ViewOverlay {
  const Viewport& viewport;
  const ViewportScene& scene;
};

/// Draws rings around nodes, the region outside which nothing moves, what is about to be moved or
/// picked, and the held part of the boundary.
void draw_overlay(ImDrawList& list, const Overlay& overlay);
/// Draws the handles of the selection and of a cut, and the point about which the view turns.
void draw_handles(ImDrawList& list, const Overlay& overlay);
/// Draws beside the mouse the numbers of a drag, or what a handle or a click does.
void draw_mouse_labels(ImDrawList& list, const Overlay& overlay);

/// Draws columns and outlines of the planned layers. Columns cut short have another colour, and the
/// reason stands beside the mouse.
void draw_layer_preview(ImDrawList& list, const Overlay& overlay);

}  // namespace winslow::gui
