#pragma once

#include <imgui.h>

#include "gui/view/overlays/view_overlay.h"
#include "gui/view/tools/ruler.h"

namespace winslow::gui {

/// Points of the ruler, the lines between them and what they measure; over all that is drawn.
void draw_ruler(ImDrawList& list, const ViewOverlay& overlay, const Ruler& ruler);

/// As it is shown: "Length 0.5412", "x +0.5   y -0.2", "-21.80 degrees against x", "Angle 90.00
/// degrees".
std::vector<std::string> measurement_lines(const Measurement& m);

}  // namespace winslow::gui
