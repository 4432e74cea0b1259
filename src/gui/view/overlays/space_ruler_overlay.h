#pragma once

#include <imgui.h>

#include <string>
#include <vector>

#include "gui/view/overlays/space_overlay.h"
#include "gui/view/tools/space_ruler.h"

namespace winslow::gui {

/// Points of the ruler, the lines between them and what they measure; over all that is drawn.
void draw_space_ruler(ImDrawList& list, const SpaceOverlay& overlay, const SpaceRuler& ruler);

/// As it is shown: "Length 0.5412", "x +0.5   y -0.2   z +0", ...
std::vector<std::string> measurement_lines(const SpaceMeasurement& m);

}  // namespace winslow::gui
