#pragma once

#include <imgui.h>

#include "gui/view/overlays/overlay.h"

namespace winslow::gui {

/// Outline of the region outside which nothing moves (SmoothOptions::keep_outside), dashed. A
/// circle without a centre is drawn about the selection, if there is one.
void draw_region(ImDrawList& list, const Overlay& overlay);

}  // namespace winslow::gui
