#pragma once

#include <imgui.h>

#include <string>
#include <vector>

#include "gui/view/overlays/space_overlay.h"
#include "gui/view/overlays/view_overlay.h"
#include "gui/view/tools/ruler.h"

namespace winslow::gui {

/// Points of the ruler, the lines between them and what they measure.
void draw_ruler(ImDrawList& list, const ViewOverlay& overlay, const Ruler& ruler);

/// Lines of text on one card beside a place, inside the view.
void draw_measurement_card(ImDrawList& list, const Theme& theme, const ScreenBox& viewport,
                           const ScreenPoint& beside, const std::vector<std::string>& lines);

/// As it is shown: "0.5412", "x +0.5  y -0.2", "-21.8 deg to x", "angle 90.0 deg".
std::vector<std::string> measurement_lines(const Measurement& m);

/// Points of the ruler, the lines between them and what they measure; over all that is drawn.
void draw_space_ruler(ImDrawList& list, const SpaceOverlay& overlay, const SpaceRuler& ruler);

/// As it is shown: "Length 0.5412", "x +0.5   y -0.2   z +0", ...
std::vector<std::string> measurement_lines(const SpaceMeasurement& m);

}  // namespace winslow::gui
