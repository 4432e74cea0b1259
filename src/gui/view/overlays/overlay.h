#pragma once

#include <imgui.h>

#include "gui/document/session/session.h"
#include "gui/render/view.h"
#include "gui/view/tools/viewport.h"
#include "gui/widgets/theme.h"

namespace winslow::gui {

/// What is drawn over the mesh for the mouse's sake.
struct Overlay {
  const Session& session;
  const Viewport& viewport;
  const ViewportScene& scene;
  const View& view;
  const Theme& theme;
};

/// What belongs to the mesh: pinned control volumes, rings around nodes, and what a drag or a panel
/// is about to do.
void draw_overlay(ImDrawList& list, const Overlay& overlay);
/// Pivot, arrows and ring of the selection.
void draw_handles(ImDrawList& list, const Overlay& overlay);
/// Beside the mouse: the numbers of a drag, or what a handle does.
void draw_mouse_labels(ImDrawList& list, const Overlay& overlay);

/// The part of draw_overlay that belongs into a picture of the mesh alone: pinned control volumes.
void draw_pins(ImDrawList& list, const Overlay& overlay);

/// Columns and outlines of the layers that are planned; those cut short in another colour, with the
/// reason beside the mouse.
void draw_layer_preview(ImDrawList& list, const Overlay& overlay);

}  // namespace winslow::gui
