#pragma once

#include "gui/view/overlays/space_overlay.h"

namespace winslow::gui {

/// Over a volume mesh, for the sake of moving something: where it would go, the pivot and its axis,
/// what a click would take, what is held of the boundary, the handle, and what is said of it beside
/// the mouse.
void draw_moving(ImDrawList& list, const SpaceOverlay& o, const SpaceViewport& viewport);

}  // namespace winslow::gui
