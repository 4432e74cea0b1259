#pragma once

#include <imgui.h>

#include "gui/view/overlays/overlay.h"

namespace winslow::gui {

/// Columns and outlines of the layers that are planned; those cut short in another colour, with the
/// reason beside the mouse.
void draw_layer_preview(ImDrawList& list, const Overlay& overlay);

}  // namespace winslow::gui
